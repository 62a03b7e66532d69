"""The runs in a recording: their scenes, their changes, and the same run simulated again."""
