"""Boxes before an arm, their plans, and what becomes of them in physics."""
