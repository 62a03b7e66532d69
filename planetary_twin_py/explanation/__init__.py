"""What a scene models, what it leaves out, and what every term of it costs and changes."""
