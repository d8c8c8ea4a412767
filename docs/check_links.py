#!/usr/bin/env python3
"""Checks every relative link, anchor and image of the Markdown files of this repository. Exit code 1 if one leads nowhere."""
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
FENCE = re.compile(r"```.*?```", re.DOTALL)


def anchors(path):
    """Anchors that GitHub gives the headings of a file."""
    headings = re.findall(r"^#+ (.*)$", FENCE.sub("", path.read_text()), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def faults(path):
    text = FENCE.sub("", path.read_text())
    defined = {name.lower() for name in re.findall(r"^\[([^\]]+)\]: ", text, re.MULTILINE)}
    for name in re.findall(r"\]\[([^\]]+)\]", text) + re.findall(r"\[([\w.]+\.h)\](?![(:\[])", text):
        if name.lower() not in defined:
            yield f"no definition of [{name}]"
    targets = re.findall(r"\]\(([^)\s]+)\)", text) + re.findall(r"^\[[^\]]+\]: (\S+)$", text, re.MULTILINE)
    for target in targets + re.findall(r'src="([^"]+)"', text):
        name, _, anchor = target.partition("#")
        file = (path.parent / name).resolve() if name else path
        if re.match(r"https?:", target):
            continue
        if not file.exists():
            yield f"{target}: no such file"
        elif anchor and file.suffix == ".md" and anchor not in anchors(file):
            yield f"{target}: no such heading"


def main():
    listed = subprocess.run(["git", "ls-files", "*.md"], cwd=ROOT, check=True, capture_output=True, text=True).stdout.split()
    found = [f"{name}: {fault}" for name in listed for fault in faults(ROOT / name)]
    print("\n".join(found) if found else f"{len(listed)} files, all links lead somewhere")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
