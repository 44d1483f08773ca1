"""Bugs in storage: undetected damage, results under the wrong key, lost digits."""

from bench.mutation.seeded.bug import Bug

SEAL = "vv/store/seal.py"
STORE = "vv/store/store.py"
MANIFEST = "vv/store/manifest_text.py"
MANIFESTS = "vv/store/manifests.py"
PROVENANCE = "vv/store/provenance.py"
CODEC = "vv/records/codec/plain_values.py"
KEYS = "vv/plan/keys.py"
FILES = "vv/base/files.py"
KEPT, KEYED = "tests/store", "tests/plan/test_keys.py tests/store"

BUGS = (
    Bug("a broken seal of a text opened", SEAL, "if whole != sealed_text(name, text):", "if False:", tests="tests/store/test_damage.py tests/store/test_store.py"),
    Bug("a broken seal of arrays opened", SEAL, "if whole[-SIZE:] != seal_of", "if whole[:0] != seal_of", tests=KEPT),
    Bug("a seal that any name opens", SEAL, "hashlib.blake2b(name.encode(", "hashlib.blake2b(''.encode(", tests=KEPT),
    Bug("a manifest's first line unsealed", MANIFEST, "    if end != f'", "    if False and end != f'", tests=KEPT),
    Bug("a case's records unsealed", MANIFEST, "    _check(seals, case, own, name)\n", "", tests=KEPT),
    Bug("a manifest of the future is the latest", MANIFESTS, "return [name for name in names if name <= tomorrow]", "return names", tests=KEPT),
    Bug("the latest is the oldest", MANIFESTS, "for name in reversed(self.names()):", "for name in self.names():", tests=KEPT),
    Bug("failures kept as runs", STORE, "if run.status is Status.RAN:", "if run.status is not None:", tests="tests/store/test_store.py"),
    Bug("half a file where one is killed", FILES, "os.replace(temporary, path)", "path.write_bytes(content[: len(content) // 2]); os.replace(temporary, path)", tests="tests/store tests/base"),
    Bug("a program known by a time that can be set back", PROVENANCE, "state.st_ctime_ns", "state.st_mtime_ns", tests="tests/store tests/plan/test_keys.py"),
    Bug("a run's key without its scheme", KEYS, "job.code, job.scheme, prints", "job.code, prints", tests=KEYED),
    Bug("a run's key without its sources", KEYS, "prints[job.code], how)", "how)", tests=KEYED),
    Bug("a run's key without its executables", KEYS, "python, sorted(external.values())", "python", tests=KEYED),
    Bug("a record's key without its class of method", KEYS, "job.parameters, job.method", "job.parameters", tests=KEYED),
    Bug("a record's key without its parameters", KEYS, "job.parameters, job.method", "job.method", tests=KEYED),
    Bug("settings alike in three digits share a name", "vv/records/reading.py", "{value:.12g}", "{value:.3g}", tests="tests/records tests/gate tests/run"),
    Bug("accepted figures of three digits", "vv/gate/baseline.py", "DIGITS = 12", "DIGITS = 3", tests="tests/gate"),
    Bug("recorded results of other parameters", "vv/gate/recorded.py", "kept.parameters.get(record.variant) == record.parameters", "kept.parameters", tests="tests/gate"),
    Bug("an infinite number read", CODEC, "if not -LARGEST <= data <= LARGEST:", "if data != data:", tests="tests/records"),
    Bug("a truth read as a number", CODEC, "if type(data) is not int:", "if not isinstance(data, int):", tests="tests/records"),
    Bug("a search's key without its source", KEYS, "prints[job.code], how)", "prints[job.code])", tests=KEYED),
    Bug("the newest past runs are the oldest", MANIFESTS, "self.names()[-most:]", "self.names()[:most]", tests="tests/store/test_parts.py"),
    Bug("the last timing session by its name", STORE, "sorted(found, key=lambda path: path.lstat().st_mtime_ns)", "sorted(found)", tests="tests/store/test_parts.py"),
    Bug("a timing session of any machine", "vv/run/timing_phase.py", "place.timer().fingerprint, REPEAT", "REPEAT", tests="tests/run/test_timing_phase.py"),
    Bug("a change of a record that keeps its size unseen", STORE, "for n in (s.st_size, s.st_mtime_ns, s.st_ctime_ns))", "for n in (s.st_size,))", tests="tests/store/test_parts.py"),
    Bug("rows of a paper kept under those of another", "vv/insight/rows_of_run.py", "        paper.name,\n", "", tests="tests/insight/test_rows_of_run.py"),
    Bug("rows of a paper kept though it was edited", "vv/insight/rows_of_run.py", "        sources,\n        closure", "        closure", tests="tests/insight/test_rows_of_run.py"),
    Bug("the least of a cost kept as its largest", "vv/gate/baseline.py", 'float(f"{relative[1]:.3g}")', 'float(f"{relative[0]:.3g}")', tests="tests/gate/test_acceptance.py"),
    Bug("the last written is recorded as the finest", "vv/gate/recorded.py", "for r in sorted(pile, key=by_fineness)}", "for r in pile}", tests="tests/gate/test_recorded_decisions.py"),
    Bug("times and values recorded in each other's place", "vv/gate/recorded.py", 'tuple(map(_few, arrays["t"][chosen])), tuple(map(_few, y[chosen]))', 'tuple(map(_few, y[chosen])), tuple(map(_few, arrays["t"][chosen]))', tests="tests/gate/test_recorded_decisions.py"),
    Bug("a recorded cost is that of what did not run", "vv/gate/recorded.py", "cpu=result.cpu", "cpu=record.cost.solve_cpu", tests="tests/gate/test_recorded_decisions.py"),
    Bug('a run is kept without its ledger', 'vv/store/run_arrays.py', 'ledger=run.ledger', 'ledger=None', tests='tests/store/test_parts.py'),
    Bug('all energies of a kept run are its times', 'vv/store/run_arrays.py', 'energies={form: arrays[name] for form', 'energies={form: arrays["t"] for form', tests='tests/store/test_parts.py'),
    Bug('all machines of one kind are one', 'vv/store/provenance.py', 'platform.node())[:12]', '"")[:12]', tests='tests/store/test_provenance.py'),
)  # fmt: skip
