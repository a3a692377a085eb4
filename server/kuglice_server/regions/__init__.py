"""What is told to views: the nodes of a quadtree that somebody looks at, and nothing else."""

from kuglice_server.regions.publisher import RegionPublisher
from kuglice_server.regions.terms import choose_terms

__all__ = ["RegionPublisher", "choose_terms"]
