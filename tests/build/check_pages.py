#!/usr/bin/env python3
"""check_pages.py: what the pages say of files, functions, figures and works is there. Exit code 1 if not.

* A number in the text of a link is on the page, or in the source, that the link leads to: `[1.4 times](notebook/...)`.
* No page outside the notebook says that its figures are older than the program: such figures belong to the notebook.
* Files, types and functions that architecture.md names exist; a line of a figure that names both has a file with each function.
* The table of compiled kernels in cuda.md has the numbers of the files that the compiler's output is compared with.
* Works that theory.md and materials.md cite are among the sources.
* README.md leads to every page, and the index of the notebook to every page there.
"""
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs"
NOTEBOOK = DOCS / "notebook"
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted(DOCS.glob("*.md")), ROOT / "assets" / "scenes" / "README.md"]
SOURCE = (".h", ".cpp", ".cu", ".cuh", ".inc")
NUMBER = r"(?<![\w.])\d+(?:\.\d+)?(?![\w]|\.\d)"
OLDER = re.compile(r"(?:is|are|was|were) (?:from|of the program) before|newer than (?:these|the|its) figures|"
                   r"figures (?:are|were) (?:from |measured )?before|[Ll]ater (?:programs|commits) have not")
CITED = r"([^\W\d_]+)(?: et al\.| and (?:[A-Z]\w+ )*[A-Z]\w+)? ((?:18|19|20)\d\d)(?!-)"


def numbers(text):
    """The numbers of a text, without the marks between groups of digits and the suffixes of C++."""
    text = re.sub(r"(?<=\d)['  ](?=\d{3}(?!\d))", "", text)
    return {float(number) for number in re.findall(NUMBER, re.sub(r"(?<=\d)f\b|(?<=\d)u\b", "", text))}


def quotes(page):
    for text, target in re.findall(r"\[([^]]*\d[^]]*)\]\(([^)#\s]+)[^)\s]*\)", page.read_text()):
        source = (page.parent / target).resolve()
        if not source.is_file() or source.suffix not in (*SOURCE, ".md", ".txt") or text == source.name:
            continue
        there = source.read_text()
        for number in sorted(numbers(text) - numbers(there) - numbers(re.sub(r"\s+", "  ", there))):
            yield f"'{text}' quotes {number:g}, which {source.relative_to(ROOT)} does not have"


def older(page):
    for found in OLDER.finditer(re.sub(r"\s+", " ", page.read_text())):
        yield f"'{found[0]}': figures that the program has outgrown belong to the notebook"


def missing_names(page):
    """Names in fenced figures and in code spans: `folder/file.h`, `Type`, `function()`, `Type::function()`."""
    listed = subprocess.run(["git", "ls-files"], cwd=ROOT, check=True, capture_output=True, text=True).stdout.split()
    words = {name: set(re.findall(r"\w+", (ROOT / name).read_text())) for name in listed if name.endswith(SOURCE)}
    every = set().union(*words.values())
    text = page.read_text()
    figures = "".join(re.findall(r"```\w*\n(.*?)```", text, re.DOTALL)).split("\n")
    for code in figures + re.findall(r"`([^`\n]+)`", text):
        files = re.findall(r"[\w/]+\.(?:h|cpp|cuh|cu|inc)\b", code)
        for name in files:
            if not any(f"/{file}".endswith(f"/{name}") for file in words):
                yield f"{name}: no such file"
        stems = tuple("/" + name.rpartition(".")[0] for name in files)
        near = set().union(*(words[file] for file in words if f"/{file}".rpartition(".")[0].endswith(stems))) if files else every
        for name in re.findall(r"\b(?:\w+::)?(\w+)\(\)", code):
            if name not in near:
                yield f"{name}(): not in {' or '.join(files) or 'the source'}"
        for name in re.findall(r"\b[A-Z][a-z]+[A-Z]\w*", code):
            if name not in every:
                yield f"{name}: not in the source"


def compiled(page):
    """Rows of the table of kernels: registers, stack, spills; instructions, loads of 4, 8 and 16 bytes, and of any address space."""
    def rows_of(name):
        lines = (line.split() for line in (ROOT / "tests" / "cuda" / name).read_text().split("\n"))
        return {tuple(line[:3]): line[3:] for line in lines if len(line) > 5 and line[1] == "trace_paths"}
    code = rows_of("machine_code.sm_90.txt")
    known = {(*kernel, *(code[key][i] for i in (0, 3, 2, 1, 5))) for key, kernel in rows_of("kernels.sm_90.txt").items() if key in code}
    table = re.findall(r"^\| \w[^|\n]* \| [^|\n]+ ((?:\| \d+ ){8})\|$", page.read_text(), re.MULTILINE)
    if not table:
        yield "no table of kernels"
    for row in table:
        if tuple(re.findall(r"\d+", row)) not in known:
            yield f"{row.strip()}: no kernel with these numbers"


def uncited(page):
    body, _, sources = (DOCS / "theory.md").read_text().partition("\n## Sources\n")
    text = body if page.name == "theory.md" else page.read_text()
    for name, year in sorted(set(re.findall(CITED, re.sub(r"\s+", " ", text)))):
        if name[0].isupper() and not any(name in work and year in work for work in re.split(r"\n\* ", sources)):
            yield f"{name} {year} is not among the sources of theory.md"


def unlisted(index, pages):
    text = index.read_text()
    for page in pages:
        if f"({page.relative_to(index.parent)})" not in text:
            yield f"does not lead to {page.relative_to(ROOT)}"


def main():
    found = [(page, fault) for page in PAGES for check in (quotes, older) for fault in check(page)]
    found += [(page, fault) for page, check in ((DOCS / "architecture.md", missing_names), (DOCS / "cuda.md", compiled),
                                                (DOCS / "theory.md", uncited), (DOCS / "materials.md", uncited)) for fault in check(page)]
    for index, pages in ((ROOT / "README.md", sorted(DOCS.glob("*.md"))), (NOTEBOOK / "README.md", sorted(NOTEBOOK.glob("2*.md")))):
        found += [(index, fault) for fault in unlisted(index, pages)]
    print("\n".join(f"{page.relative_to(ROOT)}: {fault}" for page, fault in found) if found else f"{len(PAGES)} pages say what is there")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
