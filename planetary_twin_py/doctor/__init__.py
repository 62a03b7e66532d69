"""Checks of the installation, part by part, with the fix for each problem.

Each module here checks one part. Other packages add checks through the entry-point group
`planetary_twin.checks`: functions without arguments that yield findings.
"""
