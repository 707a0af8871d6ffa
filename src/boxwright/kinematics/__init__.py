"""Exports of the articulated model for robot stacks and physics."""
