"""Runs of examples/simple_shear: their files, and their steady state."""
