"""Learning of the weights from labelled frames."""
