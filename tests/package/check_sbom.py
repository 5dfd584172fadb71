#!/usr/bin/env python3
"""Checks a bill of materials: check_sbom.py FILE PROGRAM. Each fault is a line; the status is 1 if there is one.

The rules are those of SPDX 2.3 for what such a file has, and that everything is in it of which the program is known to be made.
"""
import json
import re
import subprocess
import sys

faults = []


def expect(holds, text):
    if not holds:
        faults.append(text)


def expect_keys(thing, keys, name):
    for key in keys:
        expect(isinstance(thing.get(key), (str, bool, list, dict)) and thing[key] != "", f"{name}: {key} is missing")


def check_document(document):
    expect_keys(document, ("spdxVersion", "dataLicense", "SPDXID", "name", "documentNamespace", "creationInfo"), "document")
    expect(document["spdxVersion"] == "SPDX-2.3", "it is not SPDX 2.3")
    expect(document["dataLicense"] == "CC0-1.0", "the licence of the data has to be CC0-1.0")
    expect(document["SPDXID"] == "SPDXRef-DOCUMENT", "the document has another name than SPDX gives it")
    expect(re.fullmatch(r"https?://[^#\s]+", document["documentNamespace"]), "the name space is no URI, or has a fragment")
    created = document["creationInfo"].get("created", "")
    expect(re.fullmatch(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ", created), f"{created} is no time of SPDX")
    creators = document["creationInfo"].get("creators", [])
    expect(creators and all(re.match(r"(Tool|Organization|Person): \S", one) for one in creators), "no creators")


def check_package(package):
    name = package.get("name", "a package")
    expect_keys(package, ("SPDXID", "name", "versionInfo", "downloadLocation", "filesAnalyzed", "licenseConcluded",
                          "licenseDeclared", "copyrightText", "supplier"), name)
    expect(re.fullmatch(r"SPDXRef-[A-Za-z0-9.-]+", package["SPDXID"]), f"{name}: {package['SPDXID']} is no identifier")
    expect(re.match(r"(Organization|Person): \S", package["supplier"]), f"{name}: no supplier")
    if name == "lockstep":
        return
    installed = subprocess.run(["dpkg-query", "-W", "-f=${Version}", name], capture_output=True, text=True).stdout
    expect(installed == package["versionInfo"], f"{name}: {package['versionInfo']} is not the version that is installed")
    references = package.get("externalRefs", [])
    purls = [one["referenceLocator"] for one in references if one["referenceType"] == "purl"]
    expect(len(purls) == 1 and purls[0].startswith(f"pkg:deb/debian/{name}@"), f"{name}: no package URL")


def check_relationships(document):
    known = {"SPDXRef-DOCUMENT", *(package["SPDXID"] for package in document["packages"])}
    expect(len(known) == len(document["packages"]) + 1, "an identifier is there twice")
    related = {"SPDXRef-DOCUMENT"}
    for one in document["relationships"]:
        expect(one["relationshipType"] in ("DESCRIBES", "DYNAMIC_LINK", "STATIC_LINK", "BUILD_TOOL_OF"), str(one))
        for end in (one["spdxElementId"], one["relatedSpdxElement"]):
            expect(end in known, f"{end} is related and not there")
            related.add(end)
    expect(related == known, f"nothing says what {known - related} is for")


def check_whole(document, program):
    names = {package["name"] for package in document["packages"]}
    for name in ("nlohmann-json3-dev", "libcli11-dev", "libfmt-dev", "liblcm-dev", "libmodbus-dev",
                 "libsqlite3-dev", "libncurses-dev", "libmodbus5", "liblcm1", "libsqlite3-0", "libstdc++6", "libc6"):
        expect(name in names, f"{name} is missing")
    for name in ("libgtest-dev", "libvalijson-dev"):
        expect(name not in names, f"{name} is no part of the program")
    linked = sum(one["relationshipType"] == "DYNAMIC_LINK" for one in document["relationships"])
    needed = subprocess.run(["readelf", "-dW", program], capture_output=True, text=True, check=True).stdout.count("(NEEDED)")
    # Several libraries may come from one package, as libc and libm do.
    expect(needed >= linked >= 7, f"{linked} packages for {needed} libraries")


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        document = json.load(file)
    check_document(document)
    for package in document["packages"]:
        check_package(package)
    check_relationships(document)
    check_whole(document, sys.argv[2])
    for fault in faults:
        print(fault, file=sys.stderr)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
