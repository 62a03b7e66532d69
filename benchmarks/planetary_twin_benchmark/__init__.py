"""Speed against error: cases, a converged reference by another method, and one table."""
