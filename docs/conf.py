"""How the book is built: Sphinx reads the Markdown pages, runs the notebooks and takes the Python reference from docstrings."""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE / "_ext"))

project = "cav"
author = "the authors of cav"
copyright = author
html_title = "cav"

extensions = ["myst_nb", "sphinx.ext.autodoc", "sphinx.ext.autosummary", "mathml", "docstrings", "outside", "pictures", "sections"]
exclude_patterns = ["_build", "_ext", "_static", "check", "images", "requirements.txt"]
source_suffix = {".md": "myst-nb"}

# Headings have the anchors that GitHub gives them, so links are the same here and there.
myst_heading_anchors = 4
myst_enable_extensions = ["colon_fence", "deflist", "dollarmath", "html_image"]
myst_dmath_allow_space = False
myst_dmath_allow_digits = False

# A notebook is run again when its code has changed. The tests run all of them (`-D nb_execution_mode=force`).
nb_execution_mode = "cache"
nb_execution_show_tb = True
nb_execution_timeout = 300
nb_execution_in_temp = False
nb_merge_streams = True
nb_output_stderr = "remove-warn"

autodoc_member_order = "bysource"
autodoc_typehints_format = "short"
autodoc_preserve_defaults = True
# Types that are names for something long are shown as they are written, but for names that only the package's own files know.
autodoc_type_aliases = {
    **{name: name for name in ("ArrayLike", "NDArray", "InitialState", "Run", "Window")},
    **{name: "NDArray[np.float64]" for name in ("Array", "Floats")}}
python_use_unqualified_type_names = True
python_maximum_signature_line_length = 88
default_role = "code"
autosummary_generate = False
add_module_names = True

html_theme = "furo"
html_static_path = ["_static"]
html_css_files = ["book.css"]
html_copy_source = False
html_show_sphinx = False
html_show_copyright = False
pygments_style = "friendly"
pygments_dark_style = "github-dark"
