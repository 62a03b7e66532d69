"""What a live twin costs and how punctual it is, measured from outside its process."""
