"""Bugs by which the gate would judge wrongly: wrong results pass."""

from bench.mutation.seeded.bug import Bug

RECORD = "vv/records/record.py"
CHECKING = "vv/records/checking.py"
JUDGEMENT = "vv/gate/judgement.py"
REGRESSION = "vv/gate/regression.py"
BANDS = "vv/gate/bands.py"
DISAGREEMENT = "vv/gate/disagreement.py"
EXPIRY = "vv/gate/expiry.py"
ALL = "vv/gate/all_checks.py"
JUDGES = "vv/case/judges.py"
METRICS = "vv/base/metrics.py"
RUNGS = "vv/records/rungs.py"
DDA_AUDIT = "vv/engines/dda/general/energy.py"
GATE, MEASURED = "tests/gate", "tests/records"

BUGS = (
    Bug("an interval judged on its lower side only", RECORD, "judge.low <= found.value <= judge.high", "judge.low <= found.value", tests=MEASURED),
    Bug("an interval judged on its upper side only", RECORD, "judge.low <= found.value <= judge.high", "found.value <= judge.high", tests=MEASURED),
    Bug("audits judged only where a bound is promised", JUDGEMENT, "in ledger.audits.items():", "in (ledger.audits if ledger.bound is not None else {}).items():", tests=GATE),
    Bug("an audit that is not a number passes", JUDGEMENT, "        if not seen <= allowed:", "        if seen > allowed:", tests=GATE),
    Bug("energy that is not a number passes", JUDGEMENT, "if not ledger.unaccounted <= ledger.bound", "if ledger.unaccounted > ledger.bound", tests=GATE),
    Bug("dissipation that gives is not seen", JUDGEMENT, "and not -value <= ledger.bound", "and not value - abs(value) <= ledger.bound", tests=GATE),
    Bug("--against DIR ignored", ALL, "baseline.read(against, case) if against else baseline_of", "baseline_of(project, case) if against else baseline_of", tests="tests/gate/test_baseline.py tests/gate/test_gate.py"),
    Bug("what became too long vanishes", REGRESSION, "(Status.REFUSED, Status.NOT_RUN, Status.TOO_LONG)", "(Status.REFUSED, Status.NOT_RUN)", tests=GATE),
    Bug("drift over the scale of today", BANDS, "max(changes, default=0.0) / (then.scale or 1.0)", "max(changes, default=0.0) / (now.scale or 1.0)", tests=GATE),
    Bug("output times off by 1 % pass", CHECKING, "rtol=1e-9, atol=0.0", "rtol=2e-2, atol=0.0", tests=MEASURED),
    Bug("terms left out pass", CHECKING, "ask.scene.terms() - run.model.terms:", "False:", tests=MEASURED),
    Bug("a copy of the reference passes", RECORD, "return bool(same and np.ptp(value) > 0)", "return False", tests=MEASURED),
    Bug("what never moves passes", RECORD, "np.ptp(value) == 0 and", "np.ptp(value) < 0 and", tests=MEASURED),
    Bug("a tolerance above the largest", JUDGES, "return min(LARGEST_TOLERANCE, self.uncut(knobs))", "return self.uncut(knobs)", tests="tests/case"),
    Bug("a band of a disagreement open below", DISAGREEMENT, "band[0] <= one.error <= band[1]", "one.error <= band[1]", tests=GATE),
    Bug("any order is known", DISAGREEMENT, "if least <= order.order <= most:", "if least <= most:", tests=GATE),
    Bug("an expired entry excuses", EXPIRY, "entry.expires >= today.isoformat()", "entry.expires >= ''", tests=GATE),
    Bug("a missing code that is required is no matter", JUDGEMENT, "Status.NOT_INSTALLED: (Bit(0), Bit.INCOMPLETE)", "Status.NOT_INSTALLED: (Bit(0), Bit(0))", tests=GATE),
    Bug("the least of an audit instead of the largest", DDA_AUDIT, "worst[ADRIFT] = larger(worst[ADRIFT], abs(off))", "worst[ADRIFT] = larger(worst[ADRIFT], -abs(off))", tests="tests/engines/dda"),
    Bug("Coulomb's audit cannot fail", DDA_AUDIT, "np.sqrt(dot(rubs, rubs)) - mu * larger(push, 0.0)", "-mu * larger(push, 0.0)", tests="tests/engines/dda"),
    Bug("a final error with its sign", METRICS, "abs(value[-1] - reference[-1]) / last", "(value[-1] - reference[-1]) / last", tests="tests/base"),
    Bug("the mean of pointwise errors", METRICS, "reference[kept]) / reference[kept]).max())", "reference[kept]) / reference[kept]).mean())", tests="tests/base"),
    Bug("an error over a scale with its sign", METRICS, "np.abs(value - reference).max() / scale", "(value - reference).max() / scale", tests="tests/base"),
    Bug("a floor after three stalls", METRICS, "stalls < 2", "stalls < 3", tests="tests/base"),
    Bug("findings besides the records dropped", JUDGEMENT, "return [*own, *manifest.findings]", "return own", tests=GATE),
    Bug("the limit of the coarsest steps", RUNGS, "if r.rung.dt and r.quantities][:-4:-1]", "if r.rung.dt and r.quantities][2::-1]", tests="tests/insight"),
    Bug("a known band scaled the wrong way in dt", DISAGREEMENT, "(rung.dt or self.dt) / self.dt", "self.dt / (rung.dt or self.dt)", tests="tests/gate/known/test_disagreement.py"),
    Bug("a known band scaled the wrong way in kn", DISAGREEMENT, "(self.kn / rung.kn)", "(rung.kn / self.kn)", tests="tests/gate/known/test_disagreement.py"),
    Bug("a parameter of another value is the same", REGRESSION, "if then is not None and then != now:", "if then is not None and then.keys() != now.keys():", tests="tests/gate/test_decisions.py"),
    Bug("a quantity that is no longer reported is no matter", REGRESSION, "        return Moved(name, Change.GONE, \"has a baseline, but is no longer reported\")", "        return None", tests="tests/gate/test_baseline.py"),
    Bug("what is required need only be asked", JUDGEMENT, "seen = {record.label for record in records if ran(record) or blew_up(record)}", "seen = {record.label for record in records}", tests="tests/gate/test_judgement.py"),
    Bug("a figure that is gone has not moved", BANDS, 'return float("inf")', "return 0.0", tests="tests/gate/test_decisions.py"),
    Bug("a known breach open below", "vv/gate/known_breaches.py", "return low <= seen <= high", "return seen <= high", tests="tests/gate/known/test_breaches.py"),
    Bug("what blew up along one axis passes", CHECKING, "(np.abs(values) <= LARGEST).all(axis=1)", "(np.abs(values) <= LARGEST).any(axis=1)", tests="tests/records/test_measured.py"),
    Bug("one known breach excuses all", JUDGEMENT, "if one[0] not in record.known_breaches)", "if not record.known_breaches)", tests="tests/gate/known/test_breaches.py"),
    Bug("conservation is enforced where accuracy is", JUDGEMENT, "enforced=Check.CONSERVATION in enforced", "enforced=Check.ACCURACY in enforced", tests="tests/gate/test_gate.py::test_a_law_that_a_case_does_not_enforce_is_reported_only"),
    Bug("bands of own and of external codes exchanged", BANDS, "EXTERNAL if code in external else IN_HOUSE", "IN_HOUSE if code in external else EXTERNAL", tests="tests/gate/test_decisions.py"),
    Bug("a stored run that answers no ask is used", "vv/run/answering.py", "found = checked(run, job.ask)", "found = run", tests="tests/store/test_damage.py::test_a_stored_run_that_answers_no_ask_is_run_again"),
    Bug("a stored record without its quantities is used", "vv/run/answering.py", "if [one.name for one in summary.quantities] == due:", "if due is not None:", tests="tests/store/test_damage.py::test_a_record_that_leaves_a_quantity_out_is_made_again"),
    Bug("a value of the other sign has not moved", BANDS, "[abs(a - b) for a, b in pairs", "[abs(abs(a) - abs(b)) for a, b in pairs", tests="tests/gate/test_decisions.py"),
    Bug("what rounding moved widens no band", BANDS, "rounding = then.rounding or 0.0", "rounding = 0.0", tests="tests/gate/test_rounding.py"),
    Bug("a result that rounding moves little has no band", BANDS, "return Band(width, band.reason)", "return Band(EVERY_STEP * rounding, band.reason)", tests=GATE),
    Bug("what rounding moves is forgotten when a result is kept", "vv/gate/acceptance.py", "kept = with_wider_rounding(before, now)", "kept = before", tests="tests/gate/test_rounding.py"),
    Bug("a count that rounding decides widens its own setting alone", BANDS, "if _scheme(name) in jumping else result", "if not jumping else result", tests="tests/gate/test_rounding.py"),
    Bug("what a nudged run lost widens all settings", BANDS, "one.rounding is not None and one.rounding < LARGE", "one.rounding is not None", tests="tests/gate/test_rounding.py"),
    Bug("a breach that rounding decides has no limit", "vv/gate/known_breaches.py", "if not self.is_limited(record):", "if not record.modified:", tests="tests/gate/known/test_breaches.py"),
    Bug("all corners of a block move by the same share", "vv/plan/nudged.py", "nudge.place, group.vertices.shape)", "nudge.place)", tests="tests/gate/test_rounding.py"),
    Bug("an acceptance takes the number of another", "vv/gate/acceptance.py", "str(1 + max(map(int, old.acceptances), default=0))", "str(1 + len(old.acceptances))", tests="tests/gate/test_acceptance.py"),
    Bug("a known breach of any scheme", "vv/gate/known_breaches.py", "(record.scheme, self.schemes)", '(record.scheme, "*")', tests="tests/gate/known/test_breaches.py"),
    Bug("a law kept at other parameters is news", "vv/gate/known_breaches.py", "record.modified or not entry.breach or not", "not entry.breach or not", tests="tests/gate/known/test_breaches.py"),
    Bug("what dissipation gave told with its sign", JUDGEMENT, 'yield f"negative {name} [J]", -value', 'yield f"negative {name} [J]", value', tests="tests/gate/test_judgement.py"),
    Bug("speed by the processor of another acceptance", "vv/gate/speed.py", "baseline.acceptances[then.by]", "baseline.acceptances[max(baseline.acceptances)]", tests="tests/gate/test_speed.py"),
    Bug("a new cost is never accepted", "vv/gate/acceptance.py", "now.cost or before.cost", "before.cost or now.cost", tests="tests/gate/test_acceptance.py"),
    Bug("accepted results beside parameters of old", "vv/gate/acceptance.py", "parameters = {**old.parameters, **{r.variant: r.parameters for r in given if not r.modified}}", "parameters = {**{r.variant: r.parameters for r in given if not r.modified}, **old.parameters}", tests="tests/gate/test_acceptance.py"),
    Bug("accepted results beside parameters of a user", "vv/gate/acceptance.py", "r.parameters for r in given if not r.modified", "r.parameters for r in given", tests="tests/gate/test_acceptance.py"),
    Bug("days since an expiry are negative", EXPIRY, "expired {-days} days ago", "expired {days} days ago", tests="tests/gate/known/test_breaches.py"),
    Bug('expired entries keep a run from stopping at a failure', 'vv/gate/first_failure.py', 'known = in_force([one for path in ledgers for one in read_disagreements(path)], today)', 'known = [one for path in ledgers for one in read_disagreements(path)]', tests='tests/gate/test_first_failure.py'),
    Bug('one known quantity keeps a run from stopping at any', 'vv/gate/first_failure.py', 'one.case and one.red and one.quantity not in covered', 'one.case and one.red and not covered', tests='tests/gate/test_first_failure.py'),
    Bug('breaches in a second ledger unknown to the first failure', 'vv/gate/first_failure.py', 'for path in ledgers for entry in read_breaches(path)', 'for path in ledgers[:1] for entry in read_breaches(path)', tests='tests/gate/test_first_failure.py'),
    Bug('a crash in a check is told as a wrong answer', 'vv/cli/check_command.py', 'Answered.FAILED: CRASHED', 'Answered.FAILED: WRONG', tests='tests/cli/decisions/test_checks.py'),
    Bug('a test of pytest fails by what is reported only', 'vv/cli/job_tests.py', 'if finding.red]', 'if finding.bit]', tests='tests/cli/decisions/test_checks.py'),
    Bug('a test of pytest is judged by findings at other settings', 'vv/cli/job_tests.py', 'finding.label, finding.rung) == own', 'finding.label, own[3]) == own', tests='tests/cli/decisions/test_checks.py'),
    Bug('the general class of a method counts before its own', 'vv/case/judges.py', 'for one in (method, method.general):', 'for one in (method.general, method):', tests='tests/case/test_truths.py'),
    Bug('a parameter that is not finite is taken', 'vv/case/parameter.py', '"" if math.isfinite(value) else "must be finite"', '""', tests='tests/case/test_parameter.py'),
)  # fmt: skip
