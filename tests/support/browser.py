"""Opens a page in headless Chromium, runs a script on it, and returns the result."""

from __future__ import annotations

import html
import json
import re
import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path
from typing import Any

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser") or ""
OPTIONS = (
    "--headless", "--no-sandbox", "--disable-gpu", "--no-first-run", "--hide-scrollbars",
    "--disable-background-networking", "--disable-sync", "--enable-logging=stderr",
    "--host-resolver-rules=MAP * ~NOTFOUND",
)  # fmt: skip
# An iframe that is still written to keeps the page from being loaded, after which it is dumped:
# so a script may wait for files in real time, of which a busy machine needs more.
PROBE = """<script>
  const hold = document.body.appendChild(document.createElement("iframe"));
  hold.contentDocument.open();
  addEventListener("DOMContentLoaded", async () => {
    const all = (what) => [...document.querySelectorAll(what)], one = (what) => all(what)[0];
    const seen = (what) => all(what).filter((e) => e.checkVisibility());
    const wait = (ms) => new Promise((done) => setTimeout(done, ms));
    const until = async (test) => { for (let i = 0; i < 3000 && !test(); i++) await wait(10); };
    const said = {}; try { %s } catch (error) { said.failed = String(error); }
    said.asked = performance.getEntriesByType("resource").map((e) => e.name);
    document.title = "SAID " + JSON.stringify(said) + " DIAS";
    hold.contentDocument.close();
  });
</script></body>"""


@dataclass(frozen=True)
class Opened:
    """said: what the script put into `said`; console: complaints; asked: what is no file."""

    said: dict[str, Any]
    console: list[str]
    asked: list[str]


def opened(page: Path, script: str, scratch: Path, at: str = "", width: int = 1280) -> Opened:
    """Open a page of a report at a hash, and run a script in it once it is loaded."""
    probe = page.with_name(f"probe-{page.name}")
    probe.write_text(page.read_text(encoding="utf-8").replace("</body>", PROBE % script))
    words = [CHROMIUM, *OPTIONS, f"--user-data-dir={scratch / 'profile'}"]
    words += [f"--window-size={width},900", "--dump-dom"]
    done = subprocess.run(
        [*words, f"file://{probe}{at}"], capture_output=True, text=True, timeout=120, check=False
    )
    probe.unlink()
    found = re.search("<title>SAID (.*?) DIAS</title>", done.stdout, re.DOTALL)
    assert found, done.stderr[-2000:]
    console = [line for line in done.stderr.splitlines() if "CONSOLE" in line]
    said = json.loads(html.unescape(found[1]))
    asked = [address for address in said.pop("asked") if not address.startswith("file:")]
    return Opened(said, console, asked)
