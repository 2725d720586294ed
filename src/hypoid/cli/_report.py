"""`hypoid report`."""
