"""From submissions to grades: collect, read, record, report, export."""
