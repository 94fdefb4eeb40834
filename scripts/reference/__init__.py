"""Runs of `cav` against exact solutions of the coupled problem."""
