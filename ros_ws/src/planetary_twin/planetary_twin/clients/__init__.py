"""Programs that read and change running nodes, from the command line."""
