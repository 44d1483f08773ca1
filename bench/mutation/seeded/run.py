"""Bugs in how an invocation runs: asks, reuse of results, timing and time limits."""

from bench.mutation.seeded.bug import Bug

RUNNER = "vv/run/runner.py"
SEARCH = "vv/run/search.py"
REUSE = "vv/run/reuse.py"
ANSWERING = "vv/run/answering.py"
TIMING = "vv/run/timing_phase.py"
NARROWING = "vv/run/narrowing.py"
SETTINGS = "vv/plan/settings.py"

BUGS = (
    Bug("a lost step counts as stable", SEARCH, "if run.status is not Status.RAN:\n        return LOST", "if run.status is not Status.RAN:\n        return 0.0", tests="tests/run/test_search.py"),
    Bug("what is sought first is lost among the plain asks", SEARCH, "itertools.islice(runs, len(before))", "itertools.islice(runs, len(before) + 1)", tests="tests/run/test_search.py"),
    Bug("a worker that stays forgets the next batch", RUNNER, "        self.batch, self.answered = waiting.popleft(), 0", "        self.batch, self.answered = waiting.popleft(), 1", tests="tests/run/test_runner.py"),
    Bug("a search that never narrows", SEARCH, "np.geomspace(stable, lost, self.bracket.tries + 2)[1:-1]", "np.geomspace(stable, lost, self.bracket.tries + 2)[:-2]", tests="tests/run/test_search.py"),
    Bug("a search refined once", SEARCH, "for number in range(rounds):", "for number in range(min(2, rounds)):", tests="tests/run/test_search.py"),
    Bug("a search reports its last step", SEARCH, "first = self.runs[min(self.runs)]", "first = self.runs[max(self.runs)]", tests="tests/run/test_search.py"),
    Bug("the rest of a batch is lost", RUNNER, "        waiting.append(left)", "        pass", tests="tests/run/test_runner.py"),
    Bug("the ask after the one that died fails", RUNNER, "left = left.rest(1)", "left = left.rest(2)", tests="tests/run/test_runner.py"),
    Bug("answers come under the numbers of others", RUNNER, "yield worker.batch.numbers[worker.answered], run", "yield worker.batch.numbers[-1 - worker.answered], run", tests="tests/run/test_runner.py"),
    Bug("the clock of the first ask runs on", RUNNER, "worker.deadline = time.monotonic() + worker.timeout\n", "pass\n", tests="tests/run/test_runner.py"),
    Bug("an invocation known without its environment", REUSE, "{name: value for name, value in os.environ.items() if name.startswith(SEEN)}", "{}", tests="tests/run/test_reuse.py::test_another_environment_makes_another_invocation"),
    Bug("an invocation known without its sources", REUSE, "        _sources(project),\n", "", tests="tests/run/test_reuse.py::test_a_change_of_a_source_ends_it"),
    Bug("an invocation known without its day", REUSE, "        today.isoformat(),\n", "", tests="tests/plan/test_keys.py"),
    Bug("an invocation known without its baselines", REUSE, '_content(path) for path in against.glob("*.json")} if against else ""', '"" for path in against.glob("*.json")} if against else ""', tests="tests/run/test_reuse.py::test_a_folder_of_baselines_that_changed_judges_anew"),
    Bug("what failed stands", REUSE, "return status in LASTING or", "return True or", tests="tests/run/test_reuse.py::test_only_what_no_second_try_would_change_lets_an_invocation_stand"),
    Bug("a session with gaps stands", REUSE, " and not manifest.untimed:", ":", tests="tests/run/test_reuse.py::test_a_timing_session_with_gaps_does_not_stand_and_names_them"),
    Bug("--fresh ignored", ANSWERING, "usable = not limits.fresh and plan", "usable = plan", tests="tests/store/test_store.py::test_a_second_call_answers_from_the_store"),
    Bug("results of a code that is not here", ANSWERING, "not limits.fresh and plan.found[job.code].installed", "not limits.fresh", tests="tests/store/test_store.py::test_what_is_stored_of_a_code_does_not_stand_in_for_it_once_it_is_gone"),
    Bug("a run that cannot be measured has run", ANSWERING, "run, quantities = failed(error), []", "quantities = []", tests="tests/cli/test_outcomes.py::test_a_run_of_which_nothing_can_be_measured_has_failed"),
    Bug("the dearest round counts", TIMING, "best = min(costs,", "best = max(costs,", tests="tests/run/test_timing_phase.py"),
    Bug("a session with gaps is kept", TIMING, "if set(stored) == set(keys):", "if stored:", tests="tests/run/test_timing_phase.py"),
    Bug("a budget spent on the dearest", NARROWING, "for job in sorted(plan.jobs, key=lambda job: costs[id(job)]):", "for job in sorted(plan.jobs, key=lambda job: -costs[id(job)]):", tests="tests/run/test_narrowing.py"),
    Bug("a search believes the nearest body", SEARCH, "max(float(np.abs(values).max()) for values", "min(float(np.abs(values).max()) for values", tests="tests/run/test_search.py"),
    Bug("a search sees no way backwards", SEARCH, "float(np.abs(values).max())", "float(values.max())", tests="tests/run/test_search.py"),
    Bug("ratios to the slower calibration", "vv/run/rounds.py", "run.cost.solve_cpu / least", "run.cost.solve_cpu / most", tests="tests/run/test_rounds.py"),
    Bug("a budget for what needs it least", NARROWING, "-_closeness_to_tolerance(job, known), costs", "_closeness_to_tolerance(job, known), costs", tests="tests/run/test_narrowing.py"),
    Bug("other versions of libraries affect nothing", NARROWING, 'EVERYTHING = ("pyproject.toml", "requirements.lock")', 'EVERYTHING = ("pyproject.toml",)', tests="tests/run/test_narrowing.py"),
    Bug("the longest jobs shared out last", "vv/run/pace.py", "key=lambda place: -seconds[place]", "key=lambda place: seconds[place]", tests="tests/run/test_batching.py"),
    Bug("of several patterns for a case the last counts", "vv/plan/selection.py", "wanted.setdefault(name, set()).update(variants)", "wanted[name] = set(variants)", tests="tests/plan/test_selection.py"),
    Bug('a search at a setting with kinetic damping runs without', 'vv/ask/ask.py', 'knobs = replace(self.knobs, dt=dt)', 'knobs = Knobs(dt, self.knobs.kn)', tests='tests/run/test_search.py'),
    Bug('the cost of whole processes told as that of steps in a search', 'vv/run/search.py', 'whole=any(cost.whole for cost in costs)', 'whole=False', tests='tests/run/test_search.py'),
    Bug('a budget takes what is farthest from its bound first', 'vv/run/narrowing.py', '-_closeness_to_tolerance', '_closeness_to_tolerance', tests='tests/run/test_budget.py'),
    Bug('the gate takes no notice of --fresh', 'vv/cli/gate_command.py', 'call.fresh, timing, call.against', 'False, timing, call.against', tests='tests/cli/decisions/test_gate_and_run.py'),
    Bug('an answer stands though a new timing was asked for', 'vv/cli/invocation.py', 'not (limits.fresh or limits.timing is Timing.NEW)', 'not limits.fresh', tests='tests/cli/decisions/test_gate_and_run.py'),
    Bug('variants without timed settings are timed at any stiffness', 'vv/cli/speed_command.py', 'knobs.kn in (None, rung.kn) for', 'True for', tests='tests/cli/decisions/test_speed_and_export.py'),
    Bug('jobs that failed count as gaps of a session', 'vv/run/timing_phase.py', 'job.timed and ran(records[n])', 'job.timed', tests='tests/run/test_timing_decisions.py'),
    Bug('variants of higher levels run at any', 'vv/plan/planning.py', 'if case.variant(variant).runs_at(options.level)', 'if True', tests='tests/plan/test_planning.py'),
    Bug('an export is of the coarsest setting', 'vv/plan/planning.py', 'posed.ask(posed.rungs[-1])', 'posed.ask(posed.rungs[0])', tests='tests/plan/test_planning.py'),
    Bug('what is inert is named though it is unchanged', 'vv/plan/planning.py', 'n in inert and value != usual[n]', 'n in inert', tests='tests/plan/test_planning.py'),
    Bug('an invocation known without its machine', 'vv/run/reuse.py', '        machine(),\n', '', tests='tests/run/test_identity.py'),
    Bug('a limit of time that runs on after its end', 'vv/base/time_limit.py', '        signal.setitimer(signal.ITIMER_VIRTUAL, 0.0)\n', '', tests='tests/base/test_time_limit.py'),
    Bug('what a program started outlives it', 'vv/codes/external.py', 'end_with_descendants(program.process.pid)', 'program.process.kill()', tests='tests/codes/started/test_starts_and_ends.py'),
    Bug('work of the system is not counted to a program', 'vv/codes/program/process.py', 'used.ru_utime + used.ru_stime', 'used.ru_utime', tests='tests/codes/started/test_asked_programs.py'),
    Bug('helpers end by Ctrl-C before their parent', 'vv/base/parallel.py', '    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the parent ends it\n', '', tests='tests/base/test_parallel.py'),
)  # fmt: skip
