"""Settings of Sphinx, for `sphinx-build -W --keep-going -b html docs build/docs`: offline, executed once."""

import os
import sys
import tempfile
from importlib import metadata
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent / "_ext"))

# Figures of executed pages are drawings, sharp at any size, and all of one size and style. Kernels talk within
# this machine, unwarned. Threads are one each, as in the tests.
_profile = Path(tempfile.mkdtemp(prefix="ipython-")) / "profile_default"
_profile.mkdir()
(_profile / "ipython_kernel_config.py").write_text(
    "settings = get_config()\n"
    'settings.InlineBackend.figure_formats = {"svg"}\n'
    'settings.IPKernelApp.matplotlib = "inline"\n'
    'settings.InlineBackend.print_figure_kwargs = {"bbox_inches": None}\n'
    "settings.InlineBackend.rc = {'figure.figsize': (7.0, 3.2), 'figure.dpi': 100, 'font.size': 10.0, "
    "'figure.constrained_layout.use': True, "
    "'axes.spines.top': False, 'axes.spines.right': False, 'legend.frameon': False}\n"
    "settings.IPKernelApp.log_level = 40\n"
)
os.environ |= {"IPYTHONDIR": str(_profile.parent), "OMP_NUM_THREADS": "1"}

project = "mdr-bem-crosscheck"
release = metadata.version(project)

extensions = [
    "myst_nb",
    "sphinx.ext.autodoc",
    "sphinx.ext.mathjax",
    "sphinx-mathjax-offline",
    "sphinx_copybutton",
    "docstrings",
    "vocabularies",
]
exclude_patterns = ["*/solved/*", "joss/*"]  # whose citations are of pandoc

myst_enable_extensions = ["dollarmath", "colon_fence"]
myst_heading_anchors = 3

# Outputs of executed pages are kept next to the built ones until a cell changes; a fresh copy has none.
nb_execution_mode = "cache"
nb_execution_in_temp = True
nb_execution_timeout = 600
nb_execution_raise_on_error = True

default_role = "py:obj"
autodoc_default_options = {"members": True, "member-order": "bysource"}
add_module_names = False
maximum_signature_line_length = 72  # a longer one has a line for each argument

copybutton_prompt_text = r">>> |\.\.\. |\$ "
copybutton_prompt_is_regexp = True

html_theme = "furo"
html_static_path = ["_static"]
html_css_files = ["pages.css"]
