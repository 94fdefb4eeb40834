"""Runs and tables of scripts/bubble_tables.py."""
