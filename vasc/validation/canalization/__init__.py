"""Canalization held against the rules of geometry, and both against the literature."""
