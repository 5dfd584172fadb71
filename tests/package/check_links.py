#!/usr/bin/env python3
"""Looks whether every relative link of the installed documents leads to something that is installed: check_links.py ROOT."""

import re
import sys
from pathlib import Path
from urllib.parse import unquote

CODE = re.compile(r"^ *```.*?^ *```|``.*?``|`[^`\n]*`", re.DOTALL | re.MULTILINE)
LINK = re.compile(r"\]\(\s*<?([^)\s>]+)")


def dead_links(root: Path) -> list[str]:
    """Each as "document: link"."""
    dead = []
    for document in sorted(root.rglob("*.md")):
        for link in LINK.findall(CODE.sub("", document.read_text())):
            path = unquote(link.split("#")[0])
            if not path or re.match(r"[a-z][a-z0-9+.-]*:", path):
                continue
            target = (document.parent / path).resolve()
            if not target.exists() or root.resolve() not in target.parents:
                dead.append(f"{document.relative_to(root)}: {link}")
    return dead


if __name__ == "__main__":
    found = dead_links(Path(sys.argv[1]))
    print(*found, sep="\n", end="\n" if found else "")
    sys.exit(1 if found else 0)
