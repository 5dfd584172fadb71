#!/usr/bin/env bash
# A man page from chapters in Markdown: markdown_man.sh PAGE SECTION SUMMARY VERSION OUTPUT CHAPTER...
# What stands before the first heading of a chapter is about the file and is left out. A row of a table becomes a tagged
# paragraph, with its first cell as the tag.
set -euo pipefail
readonly page=$1 section=$2 summary=$3 version=$4 output=$5
shift 5
{
  cat <<HEAD
.TH ${page^^} $section "" "lockstep $version" "Lockstep"
.SH NAME
${page//-/\\-} \\- ${summary//-/\\-}
HEAD
  awk '
    function escaped(text) {
      gsub(/\\/, "\\e", text)
      gsub(/-/, "\\-", text)
      if (text ~ /^[.\x27]/) text = "\\\\&" text
      return text
    }
    # Marks of Markdown as fonts; links as their text.
    function shown(text,   result, found) {
      gsub(/\\\|/, "|", text)
      gsub(/<br>/, "; ", text)
      while (match(text, /\[[^][]*\]\([^)]*\)/)) {
        found = substr(text, RSTART + 1, RLENGTH - 2)
        sub(/\]\(.*/, "", found)
        text = substr(text, 1, RSTART - 1) found substr(text, RSTART + RLENGTH)
      }
      text = escaped(text)
      result = ""
      while (match(text, /`[^`]*`|\*\*[^*]*\*\*/)) {
        found = substr(text, RSTART, RLENGTH)
        gsub(/^`|`$|^\*\*|\*\*$/, "", found)
        result = result substr(text, 1, RSTART - 1) "\\fB" found "\\fP"
        text = substr(text, RSTART + RLENGTH)
      }
      return result text
    }
    function row(line,   count, i, cell, text, other) {
      gsub(/\\\|/, "\001", line)
      sub(/^\| */, "", line)
      sub(/ *\|$/, "", line)
      count = split(line, cells, / *\| */)
      for (i = 1; i <= count; i++) gsub(/\001/, "|", cells[i])
      if (!in_table) {
        for (i = 1; i <= count; i++) heading[i] = cells[i]
        in_table = 1
        return
      }
      if (line ~ /^[-| :]+$/) return
      text = ""
      for (i = 2; i <= count; i++) {
        if (cells[i] == "") continue
        other = heading[i] == "if not given" || heading[i] ~ /^(widens to|in a place of|gives|default|range|unit)$/
        if (cells[i] == "required") other = 0
        cell = other ? heading[i] ": " shown(cells[i]) : shown(cells[i])
        text = text == "" ? cell : text "; " cell
      }
      print ".TP\n\\fB" gensub_plain(shown(cells[1])) "\\fP\n" text
    }
    function gensub_plain(text) { gsub(/\\f[BP]/, "", text); return text }
    # In capital letters, as man pages have it, but for what stands for itself.
    function title(text) { return gensub_plain(text ~ /[`_]/ ? shown(text) : toupper(shown(text))) }
    FNR == 1 { body = 0; in_table = 0 }
    /^<!--/ { next }
    /^```/ { print code ? ".fi\n.RE" : ".PP\n.RS 4\n.nf"; code = !code; next }
    !body && !/^## / { next }
    code { print escaped($0); next }
    /^## / { body = 1; in_table = 0; print ".SH " title(substr($0, 4)); next }
    /^###+ / { in_table = 0; sub(/^#+ /, ""); print ".SS " gensub_plain(shown($0)); next }
    /^\|/ { row($0); next }
    { in_table = 0 }
    /^- / { print ".IP \\(bu 2\n" shown(substr($0, 3)); next }
    /^ *$/ { print ".PP"; next }
    { print shown($0) }
  ' "$@" | awk '/^\.PP$/ { pending = 1; next } { if (pending && !/^\./) print ".PP"; pending = 0; print }'
  cat <<'TAIL'
.SH FILES
.TP
.I /usr/share/lockstep/project.schema.json
the schema of the project file, for editors and programs
.TP
.I /usr/share/lockstep/part.schema.json
that of the files that a project includes
.TP
.I /usr/share/lockstep/system.schema.json
that of a system of several controllers
.TP
.I /usr/share/lockstep/projects
examples
.SH SEE ALSO
.BR lockstep (1),
.BR lockstep\-project (5),
.BR lockstep\-language (7),
.BR lockstep\-blocks (7)
TAIL
} >"$output.new"
mv "$output.new" "$output"
