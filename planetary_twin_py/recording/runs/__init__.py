"""The runs in a recording: scenes, parameter changes, and resimulation."""
