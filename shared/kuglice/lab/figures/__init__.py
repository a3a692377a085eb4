"""How the lab draws: one look, labels on the curves, and a footer that says who measured."""
