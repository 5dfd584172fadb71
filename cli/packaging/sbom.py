#!/usr/bin/env python3
"""Writes the bill of materials of a build as SPDX 2.3 JSON.

    sbom.py SOURCES BUILD PROGRAM VERSION OUTPUT

What is in it is found, not listed: the Debian packages of the libraries that the program is linked to, of the headers that its
sources include, at any depth, and of the compiler. The same build gives the same file: its time is SOURCE_DATE_EPOCH,
or, without that, the one of the program.
"""
import datetime
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys
import urllib.parse
import uuid

FOLDERS = ("tech_objects", "fb", "scheduler", "hmi_bridge", "projects", "cli")
NOT_OF_THE_PROGRAM = ("hmi_bridge/subscriber/", "projects/python/")  # an example, and a module for another program
INCLUDE = re.compile(r"^\s*#\s*include\s*<([^>]+)>", re.MULTILINE)


def output_of(*command, text=None):
    return subprocess.run(command, input=text, capture_output=True, text=True, check=True).stdout


def product_commands(sources, build):
    """The compile commands of the product, each as words."""
    commands = []
    for entry in json.loads((build / "compile_commands.json").read_text()):
        # A unity build lists the batches, which stand in the build at their folder.
        path = os.path.join(entry["directory"], entry["file"])
        batch = os.path.commonpath([path, build]) == str(build)
        file = os.path.relpath(path, build if batch else sources)
        if file.split("/")[0] in FOLDERS and not file.startswith(NOT_OF_THE_PROGRAM):
            commands.append(shlex.split(entry["command"]))
    return commands


def compiler_and_flags(commands):
    """The compiler, and where all of them together look for headers."""
    compiler, flags = "c++", []
    for words in commands:
        compiler = next(word for word in words if os.path.basename(word) != "ccache")
        words = iter(words[1:])
        for word in words:
            if word == "-isystem":
                flags.append("-isystem" + next(words))
            elif word.startswith(("-I", "-std=")):
                flags.append(word)
    return compiler, list(dict.fromkeys(flags))


def headers_of(sources, commands):
    """Every header that the sources of the product include in angle brackets, with what those include."""
    wanted = set()
    for folder in FOLDERS:
        for file in (sources / folder).rglob("*.[ch]pp"):
            if not str(file.relative_to(sources)).startswith(NOT_OF_THE_PROGRAM):
                wanted.update(INCLUDE.findall(file.read_text()))
    compiler, flags = compiler_and_flags(commands)
    text = "".join(f"#if __has_include(<{header}>)\n#include <{header}>\n#endif\n" for header in sorted(wanted))
    rule = output_of(compiler, *flags, "-M", "-x", "c++", "-", text=text)
    return {word for word in rule.replace("\\\n", " ").split() if word.startswith("/")}


def libraries_of(program):
    """The files of the libraries that the program names itself."""
    needed = re.findall(r"\(NEEDED\).*\[(.+)\]", output_of("readelf", "-dW", str(program)))
    found = dict(re.findall(r"^\s*(\S+) => (/\S+)", output_of("ldd", str(program)), re.MULTILINE))
    return {found[name] for name in needed if name in found}


def packages_of(files):
    """The Debian packages to which files belong. A file in none is not of Debian: nothing is said about it."""
    paths = set()
    for file in files:
        for path in (os.path.normpath(file), os.path.realpath(file)):
            paths.update((path, path.removeprefix("/usr") if path.startswith("/usr/lib") else "/usr" + path))
    # It ends with 1 if one of them is in no package, as one of two spellings always is.
    found = subprocess.run(["dpkg-query", "-S", *sorted(paths)], capture_output=True, text=True).stdout
    names = set()
    for line in found.splitlines():
        owners, separator, _ = line.partition(": ")
        if separator and not line.startswith("diversion "):
            names.update(owners.split(", "))
    return names


def described(name):
    """An SPDX package for an installed Debian package."""
    fields = "${Package}\n${Version}\n${Architecture}\n${source:Package}\n${source:Version}\n${Maintainer}\n${Homepage}\n"
    package, version, architecture, source, source_version, maintainer, homepage = output_of(
        "dpkg-query", "-W", "-f=" + fields, name).split("\n")[:7]
    purl = f"pkg:deb/debian/{package}@{urllib.parse.quote(version, safe='')}?arch={architecture}"
    result = {
        "SPDXID": "SPDXRef-Package-" + re.sub(r"[^A-Za-z0-9.-]", "-", package.replace("+", "-plus")),
        "name": package,
        "versionInfo": version,
        "supplier": "Organization: " + maintainer,
        "downloadLocation": "NOASSERTION",
        "filesAnalyzed": False,
        "sourceInfo": f"built from the Debian source package {source} {source_version}",
        "licenseConcluded": "NOASSERTION",
        "licenseDeclared": "NOASSERTION",
        "copyrightText": "NOASSERTION",
        "externalRefs": [
            {"referenceCategory": "PACKAGE-MANAGER", "referenceType": "purl", "referenceLocator": purl}
        ],
    }
    if homepage:
        result["homepage"] = homepage
    return result


def product(version):
    return {
        "SPDXID": "SPDXRef-Package-lockstep",
        "name": "lockstep",
        "versionInfo": version,
        "supplier": "Organization: the Lockstep developers",
        "downloadLocation": "NOASSERTION",
        "filesAnalyzed": False,
        "licenseConcluded": "NOASSERTION",
        "licenseDeclared": "Apache-2.0",
        "copyrightText": "NOASSERTION",
        "primaryPackagePurpose": "APPLICATION",
    }


def time_of(program):
    seconds = int(os.environ.get("SOURCE_DATE_EPOCH", program.stat().st_mtime))
    return datetime.datetime.fromtimestamp(seconds, datetime.timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ")


def bill(sources, build, program, version):
    commands = product_commands(sources, build)
    compiler, _ = compiler_and_flags(commands)
    linked = packages_of(libraries_of(program))
    included = packages_of(headers_of(sources, commands)) - linked
    tools = packages_of([os.path.realpath(output_of("which", compiler).strip())]) - linked - included
    own = product(version)
    packages, relationships = [own], [("SPDXRef-DOCUMENT", "DESCRIBES", own["SPDXID"])]
    for names, relate in (
        (linked, lambda other: (own["SPDXID"], "DYNAMIC_LINK", other)),
        # Compiled in: templates and inline functions are part of the program.
        (included, lambda other: (own["SPDXID"], "STATIC_LINK", other)),
        (tools, lambda other: (other, "BUILD_TOOL_OF", own["SPDXID"])),
    ):
        for name in sorted(names):
            packages.append(described(name))
            relationships.append(relate(packages[-1]["SPDXID"]))
    document = {
        "spdxVersion": "SPDX-2.3",
        "dataLicense": "CC0-1.0",
        "SPDXID": "SPDXRef-DOCUMENT",
        "name": "lockstep-" + version,
        "creationInfo": {"created": time_of(program), "creators": ["Tool: lockstep-sbom", "Organization: the Lockstep developers"]},
        "packages": packages,
        "relationships": [
            {"spdxElementId": one, "relationshipType": kind, "relatedSpdxElement": other} for one, kind, other in relationships
        ],
    }
    # A name of its own for each content, as SPDX asks.
    content = json.dumps(document, sort_keys=True)
    document["documentNamespace"] = "https://spdx.org/spdxdocs/lockstep-" + str(uuid.uuid5(uuid.NAMESPACE_URL, content))
    return document


def main():
    sources, build, program = (pathlib.Path(word) for word in sys.argv[1:4])
    version, output = sys.argv[4], pathlib.Path(sys.argv[5])
    text = json.dumps(bill(sources, build, program, version), indent=1, ensure_ascii=False) + "\n"
    whole = output.with_name(output.name + ".new")
    whole.write_text(text, encoding="utf-8")
    whole.replace(output)


if __name__ == "__main__":
    if len(sys.argv) != 6:
        sys.exit(__doc__)
    try:
        main()
    except subprocess.CalledProcessError as error:
        sys.exit(f"sbom.py: {shlex.join(error.cmd)[:200]} has failed: {error.stderr}")
