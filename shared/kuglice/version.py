"""The version of this package, which files and messages carry."""

__all__ = ["VERSION"]

VERSION = "0.1.0"
