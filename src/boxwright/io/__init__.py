"""Files in and out: clouds, models, labels, truths."""
