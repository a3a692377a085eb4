"""The lab: speed and accuracy, charted one against the other, with peers in the same run.

Nothing imports it but its own command line. Each chart is an entry in the table of `charts`: jobs that
measure rows, and a function that draws them. Every picture comes with the CSV that it was drawn from.
"""
