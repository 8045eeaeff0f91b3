(** * half-length: A polynomial medium on a ray of one half

    Claim.  For every D on the ray, which has the length of the theorem's bound, the optical
    depth and the volume rendering integral of the field, extinction and emission below exist,
    and are [exact_depth D] and [exact_radiance D].

    Written by volver prove; not to be edited. *)

From Volver Require Import CaseTactic.

Module even.

Definition field (lambda : R) : R :=
  lambda.
Definition extinction (s : R) : R :=
  3 + 12 * s ^ 2.
Definition emission (s : R) : R :=
  1.
Definition exact_depth (lambda : R) : R :=
  3 * lambda + 4 * lambda ^ 3.
Definition exact_radiance (lambda : R) : R :=
  1 - exp (- (3 * lambda + 4 * lambda ^ 3)).

Theorem half_length_even (D : R) :
  0 <= D <= 1 / 2 ->
  is_RInt (extinction_along field extinction) 0 D (exact_depth D) /\
  is_RInt (integrand field extinction emission) 0 D (exact_radiance D).
Proof. prove_case. Qed.
End even.

Module rising.

Definition field (lambda : R) : R :=
  lambda.
Definition extinction (s : R) : R :=
  3 + 12 * s ^ 2.
Definition emission (s : R) : R :=
  1 + 3 * s + 4 * s ^ 3.
Definition exact_depth (lambda : R) : R :=
  3 * lambda + 4 * lambda ^ 3.
Definition exact_radiance (lambda : R) : R :=
  2 - (2 + 3 * lambda + 4 * lambda ^ 3) * exp (- (3 * lambda + 4 * lambda ^ 3)).

Theorem half_length_rising (D : R) :
  0 <= D <= 1 / 2 ->
  is_RInt (extinction_along field extinction) 0 D (exact_depth D) /\
  is_RInt (integrand field extinction emission) 0 D (exact_radiance D).
Proof. prove_case. Qed.
End rising.

Module sloping.

Definition field (lambda : R) : R :=
  lambda.
Definition extinction (s : R) : R :=
  3 + 12 * s ^ 2.
Definition emission (s : R) : R :=
  3 - 3 * s - 4 * s ^ 3.
Definition exact_depth (lambda : R) : R :=
  3 * lambda + 4 * lambda ^ 3.
Definition exact_radiance (lambda : R) : R :=
  2 - (2 - (3 * lambda + 4 * lambda ^ 3)) * exp (- (3 * lambda + 4 * lambda ^ 3)).

Theorem half_length_sloping (D : R) :
  0 <= D <= 1 / 2 ->
  is_RInt (extinction_along field extinction) 0 D (exact_depth D) /\
  is_RInt (integrand field extinction emission) 0 D (exact_radiance D).
Proof. prove_case. Qed.
End sloping.

Module curved.

Definition field (lambda : R) : R :=
  lambda.
Definition extinction (s : R) : R :=
  3 + 12 * s ^ 2.
Definition emission (s : R) : R :=
  1 + (3 * s + 4 * s ^ 3 - 1) ^ 2.
Definition exact_depth (lambda : R) : R :=
  3 * lambda + 4 * lambda ^ 3.
Definition exact_radiance (lambda : R) : R :=
  2 - (2 + (3 * lambda + 4 * lambda ^ 3) ^ 2) * exp (- (3 * lambda + 4 * lambda ^ 3)).

Theorem half_length_curved (D : R) :
  0 <= D <= 1 / 2 ->
  is_RInt (extinction_along field extinction) 0 D (exact_depth D) /\
  is_RInt (integrand field extinction emission) 0 D (exact_radiance D).
Proof. prove_case. Qed.
End curved.
