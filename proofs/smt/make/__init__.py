"""Writes the statements."""
