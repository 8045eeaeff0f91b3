"""Sphinx: CommonMark as GitHub reads it, a theme that fits a phone and loads nothing from elsewhere."""

project = "volver"
extensions = ["myst_parser"]
html_theme = "furo"
html_title = "volver"
html_static_path = ["style.css"]
html_css_files = ["style.css"]
html_show_sourcelink = False
html_show_sphinx = False
html_show_copyright = False
html_copy_source = False
html_use_index = False
html_last_updated_fmt = None
show_authors = False
# Quotes and dashes stand as they were written.
smartquotes = False
# Headings have the anchors that GitHub gives them.
myst_heading_anchors = 6
# Of MyST's additions none, so that a page says the same here and there.
myst_disable_syntax = ["myst_line_comment", "myst_block_break", "myst_target", "myst_role", "front_matter", "footnote_ref", "footnote_def"]
# JSON with … in it, and conversations, have no highlighting, which is no fault.
suppress_warnings = ["misc.highlighting_failure"]
highlight_language = "text"
pygments_style = "default"
