"""Figures of merit against the truth of labelled frames."""
