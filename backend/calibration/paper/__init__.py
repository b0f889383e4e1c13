"""The certificate of a calibration on paper."""
