"""The version of the library within the package."""

from . import _core

__version__: str = _core.version()
