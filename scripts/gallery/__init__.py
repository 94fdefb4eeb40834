"""The gallery's pictures and films: what is run, what is drawn, how it is written."""
