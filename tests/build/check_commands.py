#!/usr/bin/env python3
"""check_commands.py PROGRAM: every command of the program in a fenced block of the pages runs, on small sizes.

The commands of a page run in its order in one folder, so that they find each other's files. Windows open on SDL's dummy driver. Left
out are synopses, whose arguments are words such as SCENE, and commands that install, build or need several processes.
"""
import os
import re
import shlex
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").glob("*.md"))]
SUBCOMMANDS = ("view", "render", "replay", "info", "convert", "devices", "inspect", "trace", "compare", "reference", "bench", "report",
               "selftest", "help")
# Values in place of the values of a page, and options that a subcommand has in addition where the page names none.
SMALL = {"--size": "48x48", "--spp": "2", "--time-limit": "0.05", "--pixel": "12,24"}
ADDED = {"render": ["--size", "--spp"], "inspect": ["--size", "--spp"], "reference": ["--size", "--spp"], "view": ["--size"],
         "trace": ["--size"], "bench": ["--size", "--time-limit"]}
SHORT_BENCH = ["--seeds", "2", "--reference-spp", "2", "--no-progress"]


def commands(page):
    """The commands of the program and of scripts, as lists of words."""
    for block in re.findall(r"```\w*\n.*?```", page.read_text(), re.DOTALL):
        for line in block.split("\n"):
            for command in re.sub(r"\s#.*|\s{3,}.*", "", line.removeprefix("$ ")).split(" && "):
                command = command.strip()
                if re.match(r"(pathlight|\./run|docs/\S+\.py)( |$)", command) and not re.search(r"\b[A-Z]{3,}\b|\[|\.\.\.", command):
                    yield shlex.split(command)


def shortened(words):
    """The same command on a small picture; None for one that builds or tests."""
    if words[0].startswith("docs/"):
        return [sys.executable, str(ROOT / words[0]), *words[1:]]
    arguments = words[1:]
    if arguments[:1] == ["test"] or "--with" in arguments:
        return None
    if not arguments or arguments[0] not in SUBCOMMANDS:
        arguments = ["view", *arguments]
    for i, option in enumerate(arguments[:-1]):
        arguments[i + 1] = SMALL.get(option) or arguments[i + 1]
    for option in ADDED.get(arguments[0], []):
        if option not in arguments and not (option == "--spp" and "--time-limit" in arguments):
            arguments += [option, SMALL[option]]
    if arguments[0] == "bench":
        arguments += SHORT_BENCH
    if arguments[0] == "view":
        arguments += ["--script", "look.script", "--software"]
    return arguments


def fault_of(program, arguments, folder):
    command = arguments if arguments[0] == sys.executable else [program, *arguments]
    run = subprocess.run(command, cwd=folder, capture_output=True, text=True, env=os.environ | {"SDL_VIDEODRIVER": "dummy"})
    missed = {"--gate", "--target-error"} & set(arguments)  # may be missed on small sizes
    if run.returncode != 0 and not (run.returncode == 5 and missed):
        return f"exit code {run.returncode}: {(run.stderr or run.stdout).strip()[-300:]}"
    if re.search(r"mean radiance 0$", run.stdout, re.MULTILINE):
        return "shows a volume that no light reaches"
    return None


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    program, count, faults = str(Path(sys.argv[1]).resolve()), 0, []
    for page in PAGES:
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "look.script").write_text("0 wait spp >= 1\n1 quit\n")
            for words in commands(page):
                arguments = shortened(words)
                if arguments is None:
                    continue
                fault, count = fault_of(program, arguments, folder), count + 1
                if fault:
                    faults.append(f"{page.relative_to(ROOT)}: {shlex.join(words)}: {fault}")
    print("\n".join(faults) if faults else f"{count} commands run")
    sys.exit(1 if faults or count == 0 else 0)


if __name__ == "__main__":
    main()
