"""Pictures and films of dumps by POV-Ray."""
