#!/usr/bin/env python3
"""package_test.py BUILD: the Debian package of a build installs into a bare system, renders there, and is removed without a trace.

The bare system is a folder with the essential packages of this machine and what they and the package depend on, and nothing else: so a
library that the package does not ask for is missing when the program starts. No network is needed. Exit code 77, with words, where this
cannot be done.
"""
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

FIELDS = ("Package", "Essential", "Provides", "Pre-Depends", "Depends")


def output_of(*command, **options):
    return subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True, **options).stdout


def names(relations):
    """[["a", "b"], ["c"]] of "a (>= 1) | b, c:any"."""
    return [[re.split(r"[\s:(]", choice.strip())[0] for choice in group.split("|")] for group in relations.split(",") if group.strip()]


def installed_packages():
    """Fields of all installed packages, by all names that they answer to."""
    text = output_of("dpkg-query", "-W", "-f", "${db:Status-Status}\t" + "\t".join("${%s}" % field for field in FIELDS) + "\n")
    packages = {}
    for line in text.splitlines():
        status, *values = line.split("\t")
        if status == "installed":
            fields = dict(zip(FIELDS, values))
            packages[fields["Package"]] = fields
    for fields in list(packages.values()):
        for (name,) in names(fields["Provides"]):
            packages.setdefault(name, fields)
    return packages


def closure(packages, depends):
    """Names of the essential packages, and of all that these and `depends` ask for."""
    wanted = names(depends) + [[name] for name, fields in packages.items() if fields["Essential"] == "yes"]
    taken = set()
    while wanted:
        choices = wanted.pop()
        known = [packages[name] for name in choices if name in packages]
        if not known:
            sys.exit(f"FAILED: a dependency is not installed here: {' | '.join(choices)}")
        fields = known[0]
        if fields["Package"] not in taken:
            taken.add(fields["Package"])
            wanted += names(fields["Pre-Depends"]) + names(fields["Depends"])
    return sorted(taken)


def make_bare_system(root, packages):
    for name in ("bin", "sbin", "lib", "lib32", "lib64", "libx32"):  # links where /usr is merged
        if Path("/", name).is_symlink():
            (root / "usr" / name).mkdir(parents=True, exist_ok=True)
            (root / name).symlink_to(f"usr/{name}")
    files = {line for line in output_of("dpkg-query", "-L", *packages).splitlines() if line.startswith("/") and os.path.lexists(line)}
    listed = "\n".join(sorted(files - {"/."})) + "\n"
    archive = root / "files.tar"
    # Packages list paths such as /lib/x, which lead through the links made above.
    subprocess.run(["tar", "--no-recursion", "-C", "/", "-cf", archive, "-T", "-"], input=listed, check=True, text=True,
                   stderr=subprocess.DEVNULL)
    subprocess.run(["tar", "-C", root, "--keep-directory-symlink", "--skip-old-files", "-xf", archive], check=True)
    archive.unlink()
    database = root / "var/lib/dpkg"
    for name in ("info", "updates", "triggers"):
        (database / name).mkdir(parents=True, exist_ok=True)
    (database / "status").write_text(output_of("dpkg-query", "-s", *packages))
    for package in packages:
        for entry in Path("/var/lib/dpkg/info").glob(f"{package}*.list"):
            if entry.name[:-len(".list")].split(":")[0] == package:
                shutil.copy(entry, database / "info")
    (root / "tmp").mkdir(exist_ok=True)


def main():
    build = Path(sys.argv[1]).resolve()
    missing = [tool for tool in ("cpack", "dpkg", "dpkg-shlibdeps", "chroot", "tar") if shutil.which(tool) is None]
    if missing or os.geteuid() != 0:
        print("skipped: needs", ", ".join(missing) if missing else "root, for chroot")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as folder:
        work = Path(folder)
        subprocess.run(["cpack", "-G", "DEB", "--config", build / "CPackConfig.cmake", "-B", work / "package"], check=True,
                       stdout=subprocess.DEVNULL)
        (package,) = (work / "package").glob("*.deb")
        depends = output_of("dpkg-deb", "-f", package, "Depends")
        print("depends on", depends.strip())
        root = work / "root"
        root.mkdir()
        kept = closure(installed_packages(), depends)
        make_bare_system(root, kept)
        print(f"a bare system of {len(kept)} packages")
        shutil.copy(package, root / "tmp/pathlight.deb")

        def inside(*command):
            print("$", *command, flush=True)
            environment = {"PATH": "/usr/sbin:/usr/bin:/sbin:/bin", "HOME": "/tmp", "DEBIAN_FRONTEND": "noninteractive"}
            subprocess.run(["chroot", root, *command], check=True, cwd=root, env=environment)

        inside("ldconfig")
        inside("dpkg", "-i", "/tmp/pathlight.deb")
        inside("pathlight", "--version")
        inside("pathlight", "render", "cornell", "--size", "32x32", "--spp", "2", "-q", "-o", "/tmp/picture.png")
        picture = (root / "tmp/picture.png").read_bytes()
        if not picture.startswith(b"\x89PNG") or len(picture) < 500:
            sys.exit("FAILED: no picture was rendered")
        inside("dpkg", "-r", "pathlight")
        left = [str(path) for path in (root / "usr").rglob("*pathlight*")]
        if left:
            sys.exit(f"FAILED: removing the package left {left}")
    print("passed")


if __name__ == "__main__":
    main()
