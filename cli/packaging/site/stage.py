#!/usr/bin/env python3
"""Lays out what the site is made of: stage.py SOURCES LOCKSTEP OUTPUT.

Every Markdown file of the sources, where it stands, with the pictures and files to which it links; links to folders go to
their README. From the built program come the pages of its commands, alarms and errors. A link to nothing stays as it is: Sphinx, which
runs strictly, tells it.
"""
import json
import os
import re
import shutil
import subprocess
import sys

sources, lockstep, output = (os.path.abspath(argument) for argument in sys.argv[1:4])
LINK = re.compile(r"(!?)\[([^][]*(?:\[[^][]*\][^][]*)*)\]\(([^)#\s]*)(#[^)\s]*)?\)")

# The pages in their order; what is not named follows by folders.
CHAPTERS = [
    ("First steps", ["README", "CHANGELOG"]),
    ("The language", ["projects/LANGUAGE", "projects/FUNCTIONS", "projects/KEYS", "fb/BLOCKS", "projects/CAMS", "projects/PLANT"]),
    ("Running it", ["cli/COMMANDS", "tech_objects/ALARMS", "hmi_bridge/MODBUS", "hmi_bridge/LCM", "hmi_bridge/RETAIN",
                    "hmi_bridge/AUDIT", "hmi_bridge/STUDIO", "hmi_bridge/tls/README", "SECURITY"]),
    ("Examples", None),
    ("Inside", None),
]


def write(path, text):
    path = os.path.join(output, path)
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


def markdown_files():
    for folder, folders, files in os.walk(sources):
        folders[:] = sorted(one for one in folders if one not in ("build", "node_modules") and not one.startswith("."))
        for name in sorted(files):
            if name.endswith(".md"):
                yield os.path.relpath(os.path.join(folder, name), sources)


def relinked(text, page):
    """The text of a page with its links as the site has them; what it links to beside pages is laid beside it."""
    folder = os.path.dirname(page)

    def link(match):
        picture, shown, target, anchor = match.groups()
        if not target or "://" in target:
            return match.group(0)
        there = os.path.normpath(os.path.join(folder, target))
        whole = os.path.join(sources, there)
        if os.path.isdir(whole):
            if not os.path.exists(os.path.join(whole, "README.md")):
                return shown  # a folder of sources
            target = os.path.join(target, "README.md")
        elif os.path.isfile(whole) and not whole.endswith(".md"):
            os.makedirs(os.path.dirname(os.path.join(output, there)), exist_ok=True)
            shutil.copyfile(whole, os.path.join(output, there))
        return f"{picture}[{shown}]({target}{anchor or ''})"

    parts = re.split(r"(^```.*?^```$)", text, flags=re.MULTILINE | re.DOTALL)
    return "".join(part if part.startswith("```") else LINK.sub(link, part) for part in parts)


def said(*arguments):
    command = [lockstep, *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=True, env={**os.environ, "COLUMNS": "100"}).stdout


def commands_page():
    def chapter(words, depth):
        text = said(*words, "--help")
        page = f"\n{'#' * depth} lockstep {' '.join(words)}\n\n```text\n{text.rstrip()}\n```\n".replace(" \n", "\n")
        listed = re.search(r"^Subcommands:\n((?:  .*\n)+)", text, re.MULTILINE)
        for line in listed.group(1).splitlines() if listed else []:
            if re.match(r"  \S", line):
                page += chapter([*words, line.split()[0]], min(depth + 1, 4))
        return page

    return "# The command line\n\nWhat `--help` says of each command.\n" + chapter([], 2)


def cell(text):
    return str(text).replace("|", "\\|").replace("\n", " ")


def alarms_page():
    page = "# Alarms and errors\n\nWhat `lockstep describe alarms` and `errors` say.\n"
    for topic, heading in (("alarms", "Technology alarms"), ("errors", "Errors of blocks")):
        entries = json.loads(said("describe", topic, "--json"))[topic]
        keys = [key for key in entries[0] if all(not isinstance(entry.get(key), (list, dict)) for entry in entries)]
        page += f"\n## {heading}\n\n| {' | '.join(keys)} |\n|{'---|' * len(keys)}\n"
        for entry in entries:
            page += f"| {' | '.join(cell(entry.get(key, '')) for key in keys)} |\n"
    return page


def toctree(caption, pages):
    lines = "\n".join(pages)
    return f"\n```{{toctree}}\n:caption: {caption}\n:maxdepth: 1\n\n{lines}\n```\n"


def index_page(pages):
    named = {page for _, chapter in CHAPTERS for page in chapter or []}
    rest = [page for page in pages if page not in named]
    examples = [page for page in rest if re.match(r"projects/\d\d_", page)]
    chapters = {"Examples": examples, "Inside": [page for page in rest if page not in examples]}
    text = "# Lockstep\n\nAn open motion-control runtime for Linux. [First steps](README.md), [the language](projects/LANGUAGE.md), [every function block](fb/BLOCKS.md).\n"
    return text + "".join(toctree(caption, chapter or chapters[caption]) for caption, chapter in CHAPTERS)


def main():
    shutil.rmtree(output, ignore_errors=True)
    pages = {page: open(os.path.join(sources, page), encoding="utf-8").read() for page in markdown_files()}
    for page, text in pages.items():
        write(page, relinked(text, page))
    made = {"cli/COMMANDS.md": commands_page(), "tech_objects/ALARMS.md": alarms_page()}
    for page, text in made.items():
        write(page, text)
    write("index.md", index_page(sorted(page.removesuffix(".md") for page in [*pages, *made])))


if __name__ == "__main__":
    main()
