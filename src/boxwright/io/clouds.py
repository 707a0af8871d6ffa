"""Clouds in and out of files."""

from boxwright.io.cloud_writers import write_pcd, write_ply

__all__ = ["write_pcd", "write_ply"]
