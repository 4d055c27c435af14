"""The site: Markdown pages and the API from Doxygen's XML. `./dev docs` builds it offline, and any warning stops it.

Formulas are plain text with Greek letters, sub- and superscripts: they read the same on the site, in an editor and in a
diff, and need neither TeX nor a script from elsewhere.
"""

import os

project = "libins"
author = "the libins authors"
copyright = "the libins authors, MIT licence"  # noqa: A001
extensions = ["myst_parser", "breathe"]
breathe_projects = {"libins": os.environ["INS_DOXYGEN_XML"]}
breathe_default_project = "libins"
breathe_domain_by_extension = {"h": "c"}
breathe_default_members = ("members", "undoc-members")
myst_heading_anchors = 3
nitpicky = True
# Types of the C library, and structs without a name.
nitpick_ignore_regex = [("c:identifier", r"u?int(_least)?(8|16|32|64)_t|size_t|bool|.*\.@\d+")]
html_theme = "furo"
html_title = "libins"
html_copy_source = False
html_show_sphinx = False
