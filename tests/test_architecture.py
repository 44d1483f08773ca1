"""Who may import what: data flows one way, and each layer knows only the ones before it."""

import ast
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
DATA = {"vv.digest", "vv.frozen", "vv.bodies", "vv.block", "vv.bonds", "vv.energy", "vv.scene"}
CORE = DATA | {"vv.ask"}
ENGINES = {"vv.exact", "vv.dem", "vv.blocks"}
JUDGED = {"vv.finding", "vv.gate", "vv.reading", "vv.record"}
COSTS = {"vv.rungs", "vv.effort", "vv.reach"}
STAND_INS = {"vv.soften", "vv.stand_in", "vv.clump", "vv.transform"}  # scenes made from scenes
KERNELS = {"vv.compiled", "vv.drive", "vv.triples"} | STAND_INS  # what engines share
DECLARED = CORE | {"vv.transform", "vv.study", "vv.judges", "vv.case", "vv.quantities"}
ASKED = CORE | STAND_INS | {
    "vv.adapter", "vv.in_house", "vv.timing", "vv.script", "vv.external", "vv",
}  # fmt: skip
HEAVY = {"scipy", "numba", "pandas", "matplotlib", "jinja2", "junitparser", "rich", "pint"}

# layer: (its files, what it may import of ours, the heavy libraries it may import at the top)
LAYERS: dict[str, tuple[str, set[str], set[str]]] = {
    "digest": ("vv/digest.py", set(), set()),
    "metrics": ("vv/metrics.py", set(), set()),
    "closure": ("vv/closure.py", set(), set()),
    "files": ("vv/files.py", set(), set()),
    "frozen": ("vv/frozen.py", set(), set()),
    "bodies": ("vv/bodies.py", {"vv.frozen"}, set()),
    "block": ("vv/block.py", {"vv.frozen"}, set()),
    "bonds": ("vv/bonds.py", {"vv.frozen"}, set()),
    "energy": ("vv/energy.py", set(), set()),
    "scene": ("vv/scene.py", DATA, set()),
    "transform": ("vv/transform.py", DATA, set()),
    "ask": ("vv/ask.py", DATA, set()),
    "soften": ("vv/soften.py", DATA, set()),
    "stand-ins": ("vv/stand_in.py", CORE | {"vv.soften"}, set()),
    "clumps": ("vv/clump.py", CORE | {"vv.soften", "vv.stand_in", "vv.transform"}, set()),
    "study": ("vv/study.py", CORE, set()),
    "judges": ("vv/judges.py", CORE, set()),
    "case": ("vv/case.py", CORE | {"vv.judges", "vv.study"}, set()),
    "quantities": ("vv/quantities.py", CORE | {"vv.case"}, set()),
    "adapter": ("vv/adapter.py", CORE, set()),
    "in-house": ("vv/in_house.py", {"vv", "vv.adapter", "vv.compiled"}, set()),
    "search": ("vv/search.py", CORE | {"vv.adapter"}, set()),
    "finding": ("vv/finding.py", set(), set()),
    "reading": ("vv/reading.py", CORE, set()),
    "record": ("vv/record.py", DECLARED | {"vv.metrics", "vv.reading"}, set()),
    "gate": ("vv/gate.py", DECLARED | JUDGED, set()),
    "disagreement": (
        "vv/disagreement.py",
        DECLARED | JUDGED | {"vv.metrics", "vv.rungs", "vv.settings"},
        set(),
    ),
    "baseline": ("vv/baseline.py", JUDGED | {"vv.settings"}, set()),
    "regression": ("vv/regression.py", CORE | JUDGED | {"vv.baseline"}, set()),
    "acceptance": (
        "vv/acceptance.py",
        CORE | JUDGED | {"vv.baseline", "vv.regression"},
        set(),
    ),
    "recorded": (
        "vv/recorded.py",
        CORE | JUDGED | {"vv.baseline", "vv.files", "vv.settings"},
        set(),
    ),
    "rungs": ("vv/rungs.py", {"vv.metrics", "vv.reading"}, set()),
    "effort": ("vv/effort.py", CORE | JUDGED | {"vv.metrics", "vv.rungs"}, set()),
    "reach": ("vv/reach.py", {"vv.effort", "vv.rungs"}, set()),
    "speed": ("vv/speed.py", JUDGED | {"vv.baseline"}, set()),
    "manifest": ("vv/manifest.py", set(), set()),
    "history": ("vv/history.py", JUDGED | {"vv.store"}, set()),
    "compare": (
        "vv/compare.py",
        JUDGED | {"vv.rungs", "vv.settings", "vv.store"},
        set(),
    ),
    "stability": ("vv/stability.py", JUDGED, set()),
    "junit": ("vv/junit.py", CORE | JUDGED | {"vv.files"}, set()),
    "wording": ("vv/wording.py", {"vv.gate"}, set()),
    "markdown": ("vv/markdown.py", JUDGED | {"vv.files", "vv.wording"}, set()),
    "exact": ("vv/exact/*.py", CORE | {"vv.exact", "vv.soften", "vv.transform"}, set()),
    "dem": ("vv/dem/*.py", CORE | {"vv.dem"} | KERNELS, {"numba"}),
    "blocks": ("vv/blocks/*.py", CORE | {"vv.blocks"} | KERNELS, {"numba"}),
    "references": ("reference_solutions/*.py", {"reference_solutions"}, set()),
    "second routes": ("reference_solutions/checks/*.py", set(), set()),
    "cases": ("cases/**/*.py", DECLARED | {"reference_solutions", "cases"}, set()),
    "adapters": ("adapters/**/*.py", ASKED | ENGINES | {"adapters"}, set()),
    "reports": (
        "reports/*.py",
        {
            "reports",
            "vv.closure",
            "vv.files",
            "vv.store",
            "vv.metrics",
            "vv.digest",
            *JUDGED,
            "vv.history",
            *COSTS,
            "vv.stability",
        },
        HEAVY,
    ),
}


def imports(path: Path) -> set[str]:
    """The modules of ours that a file imports, anywhere in it."""
    names = set()
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module:
            whole = node.module in ("vv", "adapters", "cases", "reports", "reference_solutions")
            names |= {f"{node.module}.{a.name}" for a in node.names} if whole else {node.module}
    ours = {"vv", "adapters", "cases", "reports", "reference_solutions", "tests", "bench"}
    return {name for name in names if name.partition(".")[0] in ours}


def heavy_at_the_top(path: Path) -> set[str]:
    """The slow libraries that importing a file loads."""
    found = set()
    for node in ast.parse(path.read_text()).body:
        if isinstance(node, ast.Import):
            found |= {alias.name.partition(".")[0] for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module:
            found.add(node.module.partition(".")[0])
    return found & HEAVY


def allowed(name: str, rule: set[str]) -> bool:
    return any(name == one or name.startswith(f"{one}.") for one in rule if one != "vv") or (
        name in ("vv", "vv.__version__") and "vv" in rule
    )


@pytest.mark.parametrize("layer", LAYERS)
def test_each_layer_imports_only_the_ones_before_it(layer: str) -> None:
    pattern, rule, heavy = LAYERS[layer]
    files = [path for path in ROOT.glob(pattern) if path.name != "driver.py"]
    assert files, f"no files for {layer}"
    for path in files:
        wrong = {name for name in imports(path) if not allowed(name, rule)}
        assert not wrong, f"{path.relative_to(ROOT)} must not import {sorted(wrong)}"
        slow = heavy_at_the_top(path) - heavy
        assert not slow, f"{path.relative_to(ROOT)} must import {sorted(slow)} where it uses them"


def test_an_adapter_drives_one_engine_at_most() -> None:
    for path in ROOT.glob("adapters/**/*.py"):
        engines = {e for e in ENGINES for name in imports(path) if allowed(name, {e})}
        assert len(engines) <= 1, f"{path.relative_to(ROOT)} imports {sorted(engines)}"


def test_the_tool_never_imports_content_by_name() -> None:
    for path in [*ROOT.glob("vv/*.py"), *ROOT.glob("vv/cli/*.py")]:
        content = {n for n in imports(path) if n.split(".")[0] in ("cases", "adapters")}
        assert not content, f"{path.name} imports {sorted(content)}"


def test_cases_never_name_a_code() -> None:
    """A label such as CODE/SCHEME, or the name of a program; DEM and DDA are also methods."""
    codes = {p.stem for p in (ROOT / "adapters").iterdir() if p.stem[0] not in "_."}
    programs = codes & {
        p.stem for p in (ROOT / "adapters").iterdir() if (p / "installed.py").exists()
    }
    for path in ROOT.glob("cases/**/*.py"):
        text = path.read_text().lower()
        named = set(re.findall(r"([a-z]+)/[a-z]", text)) & codes
        named |= set(re.findall(r"[a-z]+", text)) & programs
        assert not named, f"{path.name} names {sorted(named)}"


def test_every_module_of_the_tool_is_named_on_the_architecture_page() -> None:
    page = (ROOT / "docs" / "architecture.md").read_text()
    named = [p.name for p in (ROOT / "vv").glob("*.py") if p.name != "__init__.py"]
    folders = [p.name for p in (ROOT / "vv").iterdir() if (p / "__init__.py").exists()]
    missing = [n for n in named if f"`vv/{n}`" not in page]
    missing += [n for n in folders if f"`vv/{n}/`" not in page]
    assert not missing, f"docs/architecture.md says nothing of {missing}"


def test_every_file_starts_with_one_sentence_on_its_job() -> None:
    for folder in ("vv", "adapters", "cases", "reports", "reference_solutions", "tests", "bench"):
        for path in (ROOT / folder).rglob("*.py"):
            docstring = ast.get_docstring(ast.parse(path.read_text())) or ""
            assert docstring, f"{path.relative_to(ROOT)} has no docstring"
