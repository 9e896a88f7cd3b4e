"""The table of accuracy: clouds, detectors, judges and the report. Started by bench/accuracy/run."""
