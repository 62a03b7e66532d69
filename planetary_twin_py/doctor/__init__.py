"""Whether an installation is sound, part by part, and how to mend what is not.

Each module here looks at one part. Packages that add parts add their checks through the entry-point
group `planetary_twin.checks`: functions without arguments that yield
findings.
"""
