"""The thread that advances the twin, paced by the steady clock."""
