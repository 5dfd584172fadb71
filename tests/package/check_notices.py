#!/usr/bin/env python3
"""Whether the notices of compiled-in libraries stand in the package: check_notices.py COPYRIGHT BILL.

BILL is the bill of materials, which knows what is compiled in. Each fault is a line; the status is 1 if there is one. The licences and the
holders of the rights are those of Debian's own copyright files.
"""
import json
import re
import subprocess
import sys

# Interfaces of the system, whose owner says that their use puts a program under no licence of theirs.
INTERFACES = {"linux"}


def source_of(package):
    return subprocess.run(["dpkg-query", "-W", "-f=${source:Package}", package], capture_output=True, text=True).stdout


def words(text):
    return " ".join(line.strip() for line in text.splitlines() if line.strip() != ".").split()


def compiled_in(document):
    names = {package["SPDXID"]: package["name"] for package in document["packages"]}
    related = {"STATIC_LINK": set(), "DYNAMIC_LINK": set()}
    for one in document["relationships"]:
        if one["relationshipType"] in related:
            related[one["relationshipType"]].add(names[one["relatedSpdxElement"]])
    linked = {source_of(name) for name in related["DYNAMIC_LINK"]}
    # Of a library that is linked when the program starts, its own package has the notices.
    return {name for name in related["STATIC_LINK"] if source_of(name) not in linked | INTERFACES} | {"libfmt-dev"}


def faults_of(package, copyright):
    with open(f"/usr/share/doc/{package}/copyright", encoding="utf-8") as file:
        debian = file.read()
    stanza = re.search(r"^Files:\s*\*\n((?:.+\n)+)", debian, re.MULTILINE).group(1)
    holders = re.search(r"^Copyright:((?:.*\n)(?:[ \t].*\n)*)", stanza, re.MULTILINE).group(1)
    name = re.search(r"^License: (.+)$", stanza, re.MULTILINE).group(1)
    own = " ".join(words(copyright))
    if f"package {package}" not in own:
        yield f"{package} is compiled in and not named"
    for holder in filter(None, map(str.strip, holders.splitlines())):
        if " ".join(holder.split()) not in own:
            yield f"{package}: '{holder}' is missing"
    body = re.findall(rf"^License: {re.escape(name)}\n((?:[ \t].*\n?)+)", debian, re.MULTILINE)[-1]
    if name.startswith("MPL"):
        if "/usr/share/common-licenses/MPL-2.0" not in own:
            yield f"{package}: the licence is not to be found"
    elif " ".join(words(body)) not in own:
        yield f"{package}: the text of {name} is missing"


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        copyright = file.read()
    with open(sys.argv[2], encoding="utf-8") as file:
        packages = compiled_in(json.load(file))
    faults = [fault for package in sorted(packages) for fault in faults_of(package, copyright)]
    if not {"libeigen3-dev", "nlohmann-json3-dev", "libcli11-dev"} <= packages:
        faults.append(f"the bill of materials knows only {sorted(packages)}")
    for fault in faults:
        print(fault, file=sys.stderr)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
