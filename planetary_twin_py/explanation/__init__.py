"""Terms and limits of the model of a scene, and the effect and computing time of each term."""
