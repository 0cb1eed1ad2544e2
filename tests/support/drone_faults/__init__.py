"""What tests of a survey drone's faults have in common."""
