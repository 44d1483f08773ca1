"""What shows figures of docs/findings.md besides runs: tests, benches, and sources."""

from collections.abc import Mapping

DDA, RIGID = "tests/engines/dda", "tests/engines/rigid"
WORK = "tests/engines/dem/contact/test_friction_work.py"
STRENGTH = "tests/references/bonds/test_lattice_strength.py"
MFIX = "tests/references/impact/test_mfix.py"
REBOUND = "tests/references/impact/test_rebound.py"
LAGGED = "tests/references/impact/test_lagged_rules.py"
METAMORPHIC = "tests/adapters/test_metamorphic.py"
MEASURED = "tests/findings/test_measurements.py"

TESTED: Mapping[str, tuple[str, ...]] = {
    "A jam has no finite force, and each sweep of its solver passes on mu over the critical mu of "
    "the impulse of the sweep before, 1.005 here: in 200 sweeps the impulse grows to 213 times "
    "that of the weight in the first step, and the jam needs the more of those the finer the step "
    "is. "
    "The impulse that is missing in the first step times the step is the whole error": (
        "tests/findings/test_other_programs.py::"
        "test_pybullet_jams_late_since_its_sweeps_raise_the_impulse_of_a_weight_by_half_a_percent_each",
    ),
    "A box of 0.6 x 0.4 x 0.8 m thrown with the spin (1, 5, 2) 1/s keeps that spin, and its "
    "angular momentum is 14 % off after 1 s": (
        f"{DDA}/test_turning.py::test_the_published_step_has_no_gyroscopic_torque_and_says_so",
    ),
    "velocities are then off by dt/2 times the change in acceleration, and displacements by up to "
    "w^2 T dt/4 of their largest value": (
        f"{DDA}/test_dda.py::test_shaking_is_felt_in_the_middle_of_a_step_and_by_replicas_at_its_end",
    ),
    "friction makes springs without damping vibrate": (
        f"{DDA}/slides/test_walls_on_springs.py::"
        "test_fine_steps_converge_to_the_motion_on_springs_and_not_to_a_rigid_wall",
    ),
    "This is the motion of the springs and no error of the step": (
        f"{DDA}/slides/test_walls_on_springs.py::"
        "test_fine_steps_converge_to_the_motion_on_springs_and_not_to_a_rigid_wall",
    ),
    "The case judges no springs there": (
        "tests/cases/blocks/test_masonry.py::"
        "test_springs_are_judged_up_to_a_third_of_the_thrust_at_which_bed_joints_open",
    ),
    "the block creeps down slowly in `rigid`": (
        f"{RIGID}/test_stalling.py::test_a_block_that_friction_barely_holds_on_a_slope_stays",
    ),
    "until the springs carry only 1e-10 of them": (
        f"{DDA}/test_augmented_lagrangian.py::"
        "test_what_rests_no_longer_sinks_by_its_weight_over_the_springs",
    ),
    "of a block thrown over a slab that a base drags, both are 1e-5 m off at 4e-3 s, where whole "
    "steps leave 1.6e-2 m": (
        f"{DDA}/slides/test_slow_slides.py::"
        "test_slides_of_two_blocks_that_turn_at_different_times_do_not_depend_on_the_step",
    ),
    "This misplaces the stop by up to a dt^2/8": (
        f"{DDA}/slides/test_slow_slides.py::"
        "test_a_slide_of_few_steps_ends_where_it_should_and_nothing_creeps_on",
    ),
    "by 9e-4 of the answer, and by 5e-2 where friction lags": (
        f"{METAMORPHIC}::test_what_is_listed_still_goes_too_far",
        f"{METAMORPHIC}::test_the_answer_is_the_same",
    ),
    "In `dda` it falls through at 1e-3 rad, whereas `dda/augmented-lagrangian` supports it at 1e-6 "
    "rad with an error below 1e-9": (
        f"{DDA}/test_augmented_lagrangian.py::test_a_wedge_slides_down_the_narrowest_groove",
    ),
    "In steps of 1 ms `dda/augmented-lagrangian` is within its bound at 1e-8 rad": (
        f"{DDA}/slides/test_grooves.py::test_a_wedge_is_pressed_in_grooves_that_are_narrower_still",
    ),
    "sides that enclose less than 1e-9 rad are refused": (
        f"{DDA}/slides/test_grooves.py::test_sides_that_multipliers_would_take_for_parallel_are_refused",
    ),
    "So it is in grooves that are oblique to the frame, down to 1e-7 rad": (
        f"{DDA}/slides/test_grooves.py::test_in_grooves_that_are_oblique_to_the_frame_all_laws_are_kept",
    ),
    "the depth W/(4 kn sin^2(xi/2)) holds for any springs": (
        "tests/references/hard/test_wedge_on_springs.py::test_the_two_routes_agree_on_what_swings_and_slides",
    ),
    "YADE's polyhedra are 2 to 6 % off when lengths are given in units of 1e6 m, and abort in "
    "units of 1e-6 m": (f"{METAMORPHIC}::test_what_is_listed_still_goes_too_far",),
    "which makes it first order where a bond stretches and shears at once, 1.5e-6 of the force at "
    "1e-8 s": (
        "tests/adapters/yade/test_bonds.py::"
        "test_a_bond_that_stretches_and_shears_at_once_is_of_first_order",
    ),
    "4.5e-5 at 1600 steps and 1.2e-5 at 6400. The largest error falls more slowly than the step "
    "because at 6 degrees the spring starts at 0.98 of Coulomb's limit": (
        f"{LAGGED}::test_yades_hertz_on_a_wall_is_its_rule_to_every_digit",
        f"{LAGGED}::test_where_slip_begins_is_of_the_order_of_three_halves_beside_the_first",
    ),
    "at 0.6 of critical damping such a contact has a restitution of 0.095, and 0.249 if it may not "
    "pull": ("tests/findings/test_programs.py::test_a_contact_that_pulls_returns_less",),
    "DEM01 is a contact that exerts tension until the overlap ends, to 2e-8 m": (
        f"{MFIX}::test_mfix_prints_a_dropped_sphere_whose_contact_may_pull",
    ),
    "The heights of DEM02 are those of its springs to 0.21 %, whereas the manual compares them "
    "with rigid contact, which is 6.4 % off": (
        f"{MFIX}::"
        "test_what_mfix_computes_of_bounces_is_right_for_its_springs_and_not_for_rigid_contact",
    ),
    "DEM04 rolls at 2/7 v0/(mu g) with 5/7 v0": (
        f"{MFIX}::test_mfix_prints_two_sevenths_and_five_sevenths_of_a_sliding_sphere",
    ),
    "lever arms of R - U, to 0.06 % of the restitution": (
        f"{REBOUND}::"
        "test_mfix_prints_hertz_with_a_spring_of_todays_stiffness_and_the_arm_of_the_distance",
    ),
    "With linear springs it is up to 1.5 % off, at 10 degrees (0.6556, exactly 0.6456): this is "
    "the error of the Adams-Bashforth rule at its step, a 50th of the contact of two of its "
    "spheres with each other and so a 71st of one with the wall": (
        f"{REBOUND}::test_mfix_prints_linear_springs_with_the_error_of_its_step",
        f"{REBOUND}::test_finer_steps_of_mfix_lead_to_the_exact_answer_with_arms_of_the_distance",
    ),
    "exact to all 8 digits that MFiX prints of its own integration, and to 0.005 % of the "
    "velocity": (f"{MFIX}::test_mfix_prints_a_particle_that_sinks",),
    "Aluminium oxide on glass slips throughout from 25 degrees on": (
        f"{MEASURED}::test_laws_give_the_same_digits_where_an_impact_slips_throughout",
    ),
    "within one standard uncertainty, with a bias of 1e-4 and no scatter": (
        f"{MEASURED}::test_where_all_slips_codes_cannot_be_told_apart",
    ),
    "have a bias of 1.0000 to 1.0001 and no scatter where their laws are judged (34, 22 and 22 "
    "points each)": (
        f"{MEASURED}::"
        "test_laws_have_no_bias_where_they_are_judged_and_one_where_they_are_only_shown",
    ),
    "the bias is 0.98 to 0.99 with a scatter of 11, 14 and 15 %": (
        f"{MEASURED}::"
        "test_laws_have_no_bias_where_they_are_judged_and_one_where_they_are_only_shown",
    ),
    "at 0.931 of it along the unit's other three axes, at 0.559 to 0.808 in the plane of the base, "
    "and at 0.540 at least": (
        "tests/references/bonds/test_lattice_directions.py::test_it_is_weaker_along_all_other_directions",
    ),
    "gives Kratos' velocities to 5e-9": (
        "tests/findings/test_other_programs.py::"
        "test_kratos_shear_force_falls_with_the_stiffness_where_a_contact_unloads",
    ),
    "follow from y_1 = 0.02196 m, whereas the printed y_1 is 0.0221 m": (
        "tests/findings/test_papers.py::test_li_printed_the_start_of_slip_and_its_velocity_of_another_y_1",
    ),
    "5.8 % at 82 elements to 9.7 % at 37 681, 8.5 % on average over nine sizes": (
        f"{STRENGTH}::test_blocks_are_weaker_than_the_lattice_as_published",
    ),
    "the unit times 1 + 1/(6n - 6), for n elements a row": (
        f"{STRENGTH}::test_without_horizontal_bonds_all_slide_at_once",
    ),
    "3.4 % above Eq. 14 at 82 elements, 1.5 % below at 37 681": (
        f"{STRENGTH}::test_pressed_blocks_are_about_as_strong_as_the_lattice",
    ),
    "and 0.4 % at 580": (
        "tests/references/bonds/test_turning_lattice.py::test_turning_softens_the_faces",
    ),
    "`dda/published` rotates free blocks in space without gyroscopic torque": (
        f"{DDA}/test_turning.py::test_the_published_step_has_no_gyroscopic_torque_and_says_so",
    ),
    "`dda/published` does not rotate strains with a block": (
        f"{DDA}/test_strains.py::test_strains_that_stay_behind_shear_what_turns_and_published_says_so",
    ),
    "because the lever arms of weight and reaction are those at the start of a step": (
        f"{DDA}/test_turning.py::"
        "test_a_block_on_its_edge_is_late_because_lever_arms_are_of_the_start_of_a_step",
    ),
    "9e-7 of the energy put in for a sheet of 33 spheres, mu kn (v dt)^2/8 at most, and none at "
    "half the step": (
        f"{WORK}::test_in_a_sheet_knocked_so_that_contacts_open_a_coarse_step_gives_a_millionth",
        f"{WORK}::test_in_collisions_a_step_gains_no_more_than_the_end_of_a_contact_in_it",
    ),
    "that mean is along the slip, whatever force is chosen within the limit": (
        f"{WORK}::test_where_slip_turns_and_the_limit_falls_no_force_within_it_would_take_energy",
    ),
    "It refuses scenes where they do": (
        f"{DDA}/test_turning.py::test_the_second_order_step_refuses_blocks_that_rotate_and_says_why",
    ),
    "each step of `dda` takes a fixed part of all velocity": (
        "tests/cases/stability/test_kinetic_damping.py::test_a_step_hands_on_a_part_of_its_velocity",
    ),
    "Exceptions in `dda/default` are a single block, and several that cannot rotate": (
        f"{DDA}/slides/test_slow_slides.py::test_slides_of_two_blocks_that_turn_at_different_times_do_not_depend_on_the_step",
    ),
    "A sweep passes a force on by one block": (
        f"{RIGID}/test_newton.py::test_newton_steps_reach_the_answer_of_sweeps_in_fewer",
    ),
    "Its energy is slip times the mean of the forces before and after a step": (
        "tests/engines/dem/contact/test_slip.py::"
        "test_friction_at_its_limit_takes_the_mean_force_times_the_slip",
    ),
    "makes it first order and dissipates energy": (
        f"{DDA}/test_dda.py::test_a_bouncing_block_is_damped_by_the_published_spectral_radius",
        f"{DDA}/test_dda.py::test_the_step_is_first_order_at_a_fixed_stiffness",
    ),
    "`dda/default` evaluates shaking at the middle of a step": (
        f"{DDA}/test_dda.py::test_shaking_is_felt_in_the_middle_of_a_step_and_by_replicas_at_its_end",
    ),
    "it keeps up to 0.80 in `dda/lagged`, 0.33 in `dda/published` and 0.44 in "
    "`dda/generalised-alpha`": (
        f"{DDA}/slides/test_slow_slides.py::test_elsewhere_a_slide_turns_at_the_end_of_a_step",
    ),
    "In Painleve's paradox a rod jams by an impact": (
        f"{RIGID}/test_landing.py::test_a_rod_that_jams_stops_at_once_and_turns_on_to_second_order",
    ),
    "`dda` rebounds from it, because springs return an impact": (
        f"{DDA}/test_impacts.py::test_the_rebound_of_a_rod_that_jams_is_that_of_its_springs_and_damped_by_the_step",
    ),
    "In `dda` a block at rest sinks by its load over the stiffness of the springs": (
        f"{DDA}/test_eased.py::test_a_block_on_its_contacts_sinks_by_no_more_than_its_loads_over_their_stiffness",
    ),
    "A block that lands stays down, because a step passes on its mid-step velocity": (
        f"{DDA}/test_augmented_lagrangian.py::test_a_block_that_lands_stays_down_and_its_blow_takes_all_of_its_energy",
    ),
    "the scheme is of first order, and of second in positions where slip stays on a line": (
        f"{DDA}/test_augmented_lagrangian.py::test_it_is_of_first_order_and_of_second_in_places_where_a_slide_does_not_turn",
    ),
    "It refuses scenes of several blocks that rotate, as in masonry and arches": (
        f"{DDA}/test_augmented_lagrangian.py::test_springs_and_walls_of_stones_are_refused",
    ),
    "a slide that ends within a step ends at the end of that step": (
        f"{DDA}/slides/test_slow_slides.py::test_a_slide_of_few_steps_ends_where_it_should_and_nothing_creeps_on",
        f"{DDA}/slides/test_slow_slides.py::test_slides_of_two_blocks_that_turn_at_different_times_do_not_depend_on_the_step",
    ),
    "`dda/published` starts with unloaded shear springs": (
        f"{DDA}/test_published.py::test_error_under_gravity_rises_with_phi_as_the_late_slip_of_shear_springs_says",
    ),
    "No level runs that setting": (
        "tests/findings/test_rigid_and_dem.py::test_no_level_runs_a_step_of_six_phases",
    ),
    "`rigid` iterates from block to block in sweeps": (
        f"{RIGID}/test_begun_anew.py::test_a_chain_takes_stiff_newton_steps_and_never_begins_anew",
        f"{RIGID}/test_begun_anew.py::test_sweeps_are_no_more_than_allowed_and_go_on_as_long_as_each_kind_may",
    ),
    "On springs a wedge sinks into a narrow groove": (
        "tests/references/hard/test_wedge_on_springs.py::test_the_two_routes_agree_on_what_swings_and_slides",
    ),
    "The shear springs carry part of its weight while it is pressed in at the start": (
        f"{DDA}/test_eased.py::test_a_wedge_that_starts_to_slide_is_as_right_as_the_step_and_not_as_the_springs",
    ),
    "In other units it moves alike": (
        "tests/adapters/test_units.py::test_rigid_bears_a_wedge_in_a_groove_of_1e_6_rad_alike_in_all_units",
    ),
    "a block that lands in a scene of more than eight blocks penetrates for half a step": (
        f"{RIGID}/test_landing.py::test_among_more_than_eight_blocks_one_that_lands_penetrates_for_half_a_step",
    ),
    "In smaller scenes the time of landing is found and the impact is instantaneous": (
        f"{RIGID}/test_landing.py::test_a_thrown_block_flies_and_comes_down_as_it_should_at_any_step",
    ),
    "the iteration can drift away from some of them": (
        f"{RIGID}/test_walls.py::test_where_impulses_drift_leaps_or_a_fresh_start_without_them_solve_the_step",
    ),
    "`rigid` extrapolates along such a drift": (
        f"{RIGID}/test_walls.py::test_where_impulses_drift_leaps_or_a_fresh_start_without_them_solve_the_step",
        f"{RIGID}/test_begun_anew.py::test_sweeps_that_are_stuck_far_off_begin_anew_once",
    ),
    "`dda` starts contacts with the forces of a block at rest": (
        f"{DDA}/test_published.py::test_springs_charged_with_the_loads_start_a_slide_without_a_jolt",
    ),
    "breaks permanently only with `cohesionBroken` set to False": (
        "tests/adapters/yade/test_bonds.py::test_bonds_break_in_tension_and_in_shear",
    ),
    "In impacts YADE and LIGGGHTS follow different contact laws": (
        f"{REBOUND}::test_two_routes_agree_on_other_codes_conventions",
    ),
    "so that the shear force falls as a contact opens; in YADE's law it grows by increments": (
        f"{REBOUND}::test_increments_alone_are_told_apart_from_a_spring_of_todays_stiffness",
    ),
    "MindlinPhys computes shear increments with the stiffness at the end of a step": (
        f"{LAGGED}::test_stiffness_and_arm_of_the_middle_of_a_step_end_yades_first_order",
    ),
    "Elastic spheres with losses (Tsuji) follow the same law in YADE": (
        "tests/adapters/liggghts/test_numbers.py::test_restitution_is_that_of_a_contact_which_loses_by_its_share_of_critical",
        "tests/adapters/yade/test_inside_scene.py::test_elastic_contact_is_damped_along_its_normal_only",
    ),
    "with a dashpot there is a force, and the slip would stay": (
        "tests/adapters/yade/test_plan.py::test_what_only_touches_is_pushed_where_a_dashpot_would_let_it_keep_a_slip",
    ),
    "gives every printed digit at every angle": (
        f"{REBOUND}::test_mfix_prints_linear_springs_with_the_error_of_its_step",
    ),
    "DEM06 is a particle that sinks in gas with the drag of Schiller and Naumann": (
        f"{MFIX}::test_mfix_prints_a_particle_that_sinks",
    ),
    "A direct implementation of the rule gives these digits; if it counts": (
        "tests/references/contact/test_late_closing.py::test_a_spring_charged_for_the_whole_closing_step_has_the_digits_of_the_codes",
    ),
    "LMGC90 imposes a lock across the plane as a further constraint": (
        "tests/adapters/lmgc90/test_driver.py::"
        "test_locks_that_nothing_pushes_on_are_left_free_and_shaking_acts_on_mass",
    ),
    "Its adapter omits such locks where nothing pushes in their direction": (
        "tests/adapters/lmgc90/test_refusals.py::test_locks_matter_where_weight_loads_or_drives_push_and_in_piles",
        "tests/adapters/lmgc90/test_driver.py::test_locks_that_nothing_pushes_on_are_left_free_and_shaking_acts_on_mass",
    ),
    "Like YADE and LIGGGHTS it loads a shear spring for the whole step": (
        f"{LAGGED}::test_kratos_linear_spring_on_a_wall_is_its_rule_to_three_digits",
    ),
    "With the arm at its middle a tenth of that error would remain": (
        f"{LAGGED}::test_the_rule_told_apart_from_arms_of_the_middle_of_the_overlap",
    ),
    "With friction it is a fourth law beside those": (
        "tests/findings/test_other_programs.py::test_kratos_shear_force_falls_with_the_stiffness_where_a_contact_unloads",
    ),
}

BENCHES: Mapping[str, str] = {
    "In 9 of 200 random scenes of one or two boxes (2.5e-3 s, 1e8 N/m) the ledger of `dda/lagged` "
    "shows that friction adds energy, 22 to 1180 J, and 17 diverge": "bench.chance.random_scenes",
    "`dda/generalised-alpha` refuses 174 of these scenes and diverges in 2": (
        "bench.chance.random_scenes"
    ),
    "In 0.6 % of the steps of a facade of 216 blocks that is shaken apart at 0.51 g, and in 3.6 % "
    "at 0.72 g": "bench.speed.masonry",
    "replace them: every step reaches a residual of 5e-6 m/s": "bench.speed.masonry",
    "Every step of a wall of 205 blocks that slides at 0.72 g then reaches 5e-6 m/s": (
        "bench.speed.block_wall"
    ),
    "in 373 sweeps on average, which take 12.6 ms of CPU a step": "bench.speed.block_wall",
}

CITED, MEANT = "as its source prints it", "a definition, not a figure"
SAID: Mapping[str, str] = {
    "There w dt is 1": MEANT,
    "The other settings with w dt = 1": MEANT,
    "would leave the limit at 2/w": MEANT,
    "LIGGGHTS ends with a mesh error when lengths are given in units of 1e6 m": (
        "the test of units leaves it out, as the page says"
    ),
    "the arm is R - U/2; its torque has R - U/2": MEANT,
    "the effective radius of a sphere and a wall to be R/2": MEANT,
    "the velocity of the step before t = 0": MEANT,
    "at a restitution of 0.98 a sphere that sticks to another": "it is in the command",
    "Warnett and others (2014) measured such an effect": CITED,
    "(Hsieh and others 2011; Korzec and Jankowski 2018)": CITED,
    "(Wartman, Seed and Bray 2005, whose rigid blocks move by 27 to 225 % of what was measured)": (
        CITED
    ),
    "(Sarlin and others 2021), rods (Trepanier and Franklin 2010)": CITED,
    "effect of the size of grains (Warnett and others 2014)": CITED,
    "Foerster and others (1994) and Lorenz, Tuozzolo and Louge (1997)": CITED,
    "(2012, arXiv:1204.0001)": CITED,
    "Tsesarsky, Hatzor and Sitar (2005)": CITED,
    "Mankoc and others (2007)": CITED,
    "The published shortfall of T_u of blocks, 8.89 % on average": CITED,
    "the paper's mean of C_u, 18.51 % below": CITED,
    "The paper has 16.2 % and 2.83e-6 s, at a 25th of the rate": CITED,
}

MEANING, CONCLUDED, PEOPLE = (
    "says what is meant, not what was found",
    "follows from the sentences beside it, which are shown",
    "of sources and people, not of a run",
)
SAID_WITHOUT_FIGURES: Mapping[str, str] = {
    "dividing would take many times the solutions there": MEANING,
    "Rigid contact does not determine which of the possible answers is taken": CONCLUDED,
    "`dda/lagged` is not changed, since it shows what the lag alone does": MEANING,
    "MFiX's printed answers are explained": CONCLUDED,
    "LIGGGHTS begins such a contact without the dashpot": CONCLUDED,
    "Validation here shows whether a model agrees with an experiment": MEANING,
    "It does not show whether a code solves the model": MEANING,
    "No number mixes the two": MEANING,
    "A measurement holds only at its own parameters": MEANING,
    "So the deviation of the law without micro-slip is due to micro-slip": CONCLUDED,
    "The points that are judged were chosen by people who knew where the laws fail": PEOPLE,
    "so the floor has a layer of fixed spheres": MEANING,
    "No source states the uncertainty of Kharaz' measurements": PEOPLE,
    "What can be cited with its numbers is the spin that Kharaz measured": PEOPLE,
    "The paper does not mention such platens": PEOPLE,
}
