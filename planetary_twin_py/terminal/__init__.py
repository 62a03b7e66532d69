"""What commands share: arguments, messages, tables, output files, interrupts."""
