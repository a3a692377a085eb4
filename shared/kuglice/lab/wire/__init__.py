"""What a world takes on the wire, however many balls it has: `kuglice bench wire`."""
