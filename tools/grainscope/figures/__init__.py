"""Figures of runs and of studies."""
