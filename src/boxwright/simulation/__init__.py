"""Simulated scenes and sensor. Imports neither perception nor inference, nor they it."""
