"""Inspection: measuring grids, deviations, corrections."""
