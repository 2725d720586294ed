"""`hypoid contact`."""
