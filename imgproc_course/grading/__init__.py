"""The teacher's wing: from masters to lessons to keys and grades. Nothing in it knows about images."""
