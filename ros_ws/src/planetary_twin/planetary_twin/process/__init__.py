"""What a process with nodes needs of the operating system and of the C library."""
