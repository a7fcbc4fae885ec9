"""The report of a run: one HTML page with figures and tables. It reads what phases and service found and judges nothing."""
