"""What scripts/paper_figures.py has beside pycav's pictures."""
