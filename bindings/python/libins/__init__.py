"""libins: inertial navigation from the sensor's volts to a message on the network."""
