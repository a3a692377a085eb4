"""Ways of placing balls, one file each. Equal recipes place equal balls, bit for bit, on every platform."""

from kuglice.layout.group import Placement
from kuglice.layout.lattice import LatticeGroup
from kuglice.layout.listed import ListedGroup
from kuglice.layout.random import RandomGroup
from kuglice.layout.table import Group, place
from kuglice.layout.triangle import TriangleGroup

__all__ = ["Group", "LatticeGroup", "ListedGroup", "Placement", "RandomGroup", "TriangleGroup", "place"]
