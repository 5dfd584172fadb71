# How Sphinx makes the site: ./dev docs. What it reads is laid out by stage.py.
project = "Lockstep"
author = "the Lockstep developers"
copyright = author
extensions = ["myst_parser"]
source_suffix = {".md": "markdown"}
root_doc = "index"
html_theme = "alabaster"
html_theme_options = {"description": "motion-control runtime for coupled axes", "page_width": "1200px", "show_powered_by": False,
                      "fixed_sidebar": True}
html_show_sourcelink = False
html_copy_source = False
html_sidebars = {"**": ["about.html", "searchbox.html", "navigation.html"]}
# Anchors of headings as repositories have them, so that links between the files are the same in both.
myst_heading_anchors = 4
# Parts of JSON with "…" in them are no JSON to the highlighter; documents may begin below the first level.
suppress_warnings = ["misc.highlighting_failure"]
