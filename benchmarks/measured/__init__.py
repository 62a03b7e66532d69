"""The twin beside measured and published figures: `python -m measured PAGE` in benchmarks/."""
