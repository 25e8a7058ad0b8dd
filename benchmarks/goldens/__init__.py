"""Golden digests: what all tools write on a small survey, so that no commit changes it unseen."""
