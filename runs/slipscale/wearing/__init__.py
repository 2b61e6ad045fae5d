"""What a contact wears off and how hot it gets, from the sums over every step in contact.h5. SI units."""
