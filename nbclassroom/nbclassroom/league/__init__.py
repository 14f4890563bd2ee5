"""A class's controllers explore secret rooms, and a page ranks them."""
