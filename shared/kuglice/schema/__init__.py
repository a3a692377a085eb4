"""What every schema of this package is made of: number types, and findings told as one error."""
