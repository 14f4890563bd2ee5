"""Controllers: a function drives a robot through scenarios, and thresholds judge the drive."""
