"""Claims about inputs of codes on a page: what is copied or saved is what the code was given."""

from __future__ import annotations

from pathlib import Path

from reports import html
from reports.beside import Beside
from tests.reports.script.made_up import in_browser, seen
from tests.support.fabricated import manifest, ran, with_external
from vv.records.job_record import Record
from vv.store.store import Store

pytestmark = in_browser
HEAD = [f"# beginning {n}\n" for n in range(150)]
FIRST = [f"line {n} of what both say, with <signs> & more\n" for n in range(40)]
OTHER = [
    "a new first line\n",
    *FIRST[1:10],
    *FIRST[12:20],  # two lines less
    "one more\n", "and another\n",
    *FIRST[20:30],
    "changed 30\n", "and a line beside it\n",
    *FIRST[31:39],
    "a new last line\n",
]  # fmt: skip
TEXTS = {name: "".join(HEAD + lines) for name, lines in (("T1", FIRST), ("T2", OTHER))}
TAKE = """
  said.saved = {}; said.copied = [];
  URL.createObjectURL = (blob) => { said.blob = blob; return "#"; };
  HTMLAnchorElement.prototype.click = function () { said.file = this.download; };
  Object.defineProperty(navigator, "clipboard", { value: {
    writeText: async (text) => { said.copied.push(text); } }, configurable: true });
  const buttons = [...document.querySelectorAll(".input [data-save]")];
  for (const button of buttons) {
    said.blob = null;
    button.click();
    await until(() => said.blob);
    said.saved[said.file] = await said.blob.text();
  }
  for (const button of document.querySelectorAll(".input [data-copy]")) {
    const before = said.copied.length;
    button.click();
    await until(() => said.copied.length > before && button.textContent === "copied");
  }
  const command = one(".input .cmd");
  command.click();
  await until(() => command.title === "copied");
  said.command = [said.copied.pop(), command.textContent];
"""


def native(record: Record) -> str:
    return TEXTS[record.variant]


def test_what_is_saved_and_copied_is_whole_though_the_page_has_differences_alone(
    store: Store, tmp_path: Path
) -> None:
    runs = [ran(store, "other/default", v, 1e-3, "pass") for v in TEXTS]
    whole = with_external(manifest(*runs), "other")
    folder = html.build(whole, store, store.root / "report", Beside([], native)).parent
    page = folder / "case-bounce.html"
    text = page.read_text()
    assert "data-base" in text
    assert "data-head" in text
    assert text.count("line 5 of what both say") == 1
    said = seen(page, TAKE, tmp_path)
    assert said["saved"] == {f"bounce-{name}-other.in": text for name, text in TEXTS.items()}
    assert said["copied"] == [*TEXTS.values()]
    assert said["command"][0] == said["command"][1]
    assert said["command"][0].startswith("vv export bounce:T1 --code other/default")
