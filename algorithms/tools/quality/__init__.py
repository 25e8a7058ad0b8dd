"""Quality: measures a classified survey, and compares it with a specification."""
