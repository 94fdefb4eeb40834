"""Runs and tables of scripts/validation.py."""
